// Parametric waves y = A u^K, u = (sin theta + 1)/2 (Van Drasek et al. 2010, in Yingst et al. 2011); metres.
// theta = phase - k.p; the phase holds time and the eye's place, reduced in float64. Exact to float32 at any time.
uniform vec4 u_parametric[PARAMETRIC_COUNT]; // k.x, k.z (rad/m), A (m), K
uniform float u_parametric_phase[PARAMETRIC_COUNT];
uniform vec2 u_parametric_mean[PARAMETRIC_COUNT]; // mean square slope and mean height (m) of the whole wave

// Height over A, and its derivative by theta. With s = sin(theta/2 + pi/4): u = s^2 and du/dtheta = s cos(theta/2 + pi/4).
// twice: 2K where that is a whole number and the power a product, else 0.
vec2 parametric_profile(float theta, float exponent, int twice) {
    float half_angle = 0.5 * theta + 0.25 * PI;
    float s = sin(half_angle);
    float q = abs(s);
    float slope_sign = s < 0.0 ? -cos(half_angle) : cos(half_angle);
    if (twice > 0) {
        float product = 1.0;
        float square = q;
        for (int bits = twice - 1; bits > 0; bits >>= 1) {
            if ((bits & 1) == 1) {
                product *= square;
            }
            square *= square;
        }
        return vec2(product * q, exponent * product * slope_sign);
    }
    // K < 1/2 has an infinite slope at the trough: held there, in the derivative alone.
    float power = pow(max(q, exponent < 0.5 ? 1e-4 : 1e-30), 2.0 * exponent - 1.0);
    float height = exponent < 0.5 && q < 1e-4 ? (q > 0.0 ? pow(q, 2.0 * exponent) : 0.0) : power * q;
    return vec2(height, exponent * power * slope_sign);
}

float parametric_theta(int i, vec2 p) {
    return wrap_phase(u_parametric_phase[i] - dot(u_parametric[i].xy, p));
}

// Height and its gradient.
vec3 parametric_waves(vec2 p) {
    vec3 sum = vec3(0.0);
    for (int i = 0; i < PARAMETRIC_COUNT; ++i) {
        vec4 wave = u_parametric[i];
        vec2 profile = wave.z * parametric_profile(parametric_theta(i, p), wave.w, PARAMETRIC_TWICE[i]);
        sum += vec3(profile.x, -profile.y * wave.xy);
    }
    return sum;
}

// Height and gradient with what is smaller than the footprint taken out, and the mean square slope taken out.
vec4 parametric_shading(vec2 p, Footprint fp) {
    vec4 sum = vec4(0.0);
    for (int i = 0; i < PARAMETRIC_COUNT; ++i) {
        vec4 wave = u_parametric[i];
        vec2 profile = wave.z * parametric_profile(parametric_theta(i, p), wave.w, PARAMETRIC_TWICE[i]);
        float kept = 1.0;
        if (SURFACE_FILTER) {
            float a = dot(wave.xy, fp.x);
            float b = dot(wave.xy, fp.y);
            kept = exp(-0.125 * min(a * a + b * b, 600.0));
        }
        vec2 mean = u_parametric_mean[i];
        sum += vec4(mix(mean.y, profile.x, kept), -kept * profile.y * wave.xy, (1.0 - kept * kept) * mean.x);
    }
    return sum;
}
