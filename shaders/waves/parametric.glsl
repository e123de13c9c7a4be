// Parametric waves y = A u^K, u = (sin theta + 1)/2 (Van Drasek et al. 2010, in Yingst et al. 2011); metres.
// theta = phase - k.p; the phase holds time and the eye's place, reduced in float64. Exact to float32 at any time.
uniform vec4 u_parametric[PARAMETRIC_COUNT]; // k.x, k.z (rad/m), A (m), K
uniform float u_parametric_phase[PARAMETRIC_COUNT];
uniform vec2 u_parametric_mean[PARAMETRIC_COUNT]; // mean square slope and mean height (m) of the whole wave

// Height over A, and its derivative by theta. kind: 2K where that is a whole number and the power a product; 0: any K from 1 on;
// -1: any K at all.
vec2 parametric_profile(float theta, float exponent, int kind) {
    if (kind >= 0) {
        float u = max(0.5 + 0.5 * sin(theta), 0.0);
        float power = 1.0;
        if (kind > 0) {
            // u^(K - 1): the squares of the bits of floor(K - 1), and a root where K is half a whole number.
            int whole = (kind - 2) >> 1;
            float u2 = u * u;
            float u4 = u2 * u2;
            power = (whole & 1) != 0 ? u : 1.0;
            power *= (whole & 2) != 0 ? u2 : 1.0;
            power *= (whole & 4) != 0 ? u4 : 1.0;
            power *= (whole & 8) != 0 ? u4 * u4 : 1.0;
            power *= (kind & 1) != 0 ? sqrt(u) : 1.0;
        } else {
            power = pow(max(u, 1e-30), exponent - 1.0);
        }
        return vec2(power * u, 0.5 * exponent * power * cos(theta));
    }
    // By the half angle, which keeps its digits at the trough, where u^(K - 1) has no end: u = s^2, du/dtheta = s c.
    float half_angle = 0.5 * theta + 0.25 * PI;
    float s = sin(half_angle);
    float q = abs(s);
    float slope_sign = s < 0.0 ? -cos(half_angle) : cos(half_angle);
    // K < 1/2 has an infinite slope at the trough: held there, in the derivative alone.
    float power = pow(max(q, exponent < 0.5 ? 1e-4 : 1e-30), 2.0 * exponent - 1.0);
    float height = exponent < 0.5 && q < 1e-4 ? (q > 0.0 ? pow(q, 2.0 * exponent) : 0.0) : power * q;
    return vec2(height, exponent * power * slope_sign);
}

int parametric_kind(int i) {
    return PARAMETRIC_ALIKE ? PARAMETRIC_KIND[0] : PARAMETRIC_KIND[i];
}

float parametric_theta(int i, vec2 p) {
    return wrap_phase(u_parametric_phase[i] - dot(u_parametric[i].xy, p));
}

// Height and its gradient.
vec3 parametric_waves(vec2 p) {
    vec3 sum = vec3(0.0);
    for (int i = 0; i < PARAMETRIC_COUNT; ++i) {
        vec4 wave = u_parametric[i];
        vec2 profile = wave.z * parametric_profile(parametric_theta(i, p), wave.w, parametric_kind(i));
        sum += vec3(profile.x, -profile.y * wave.xy);
    }
    return sum;
}

// What fronts read of the place that was shaded last, so that it costs no sine of its own: the waves' sum as an analytic signal (m)
// and its derivatives by x and z. docs/formulae.md, section 4.
vec2 parametric_signal;
vec2 parametric_signal_x;
vec2 parametric_signal_z;

// Height and gradient with what is smaller than the footprint taken out, and the mean square slope taken out.
vec4 parametric_shading(vec2 p, Footprint fp) {
    vec4 sum = vec4(0.0);
    parametric_signal = vec2(0.0);
    parametric_signal_x = vec2(0.0);
    parametric_signal_z = vec2(0.0);
    for (int i = 0; i < PARAMETRIC_COUNT; ++i) {
        vec4 wave = u_parametric[i];
        float theta = parametric_theta(i, p);
        vec2 profile = wave.z * parametric_profile(theta, wave.w, parametric_kind(i));
        if (PARAMETRIC_SIGNAL) {
            vec2 term = wave.z * vec2(cos(theta), sin(theta));
            // d theta / d p = -k
            vec2 turned = vec2(term.y, -term.x);
            parametric_signal += term;
            parametric_signal_x += wave.x * turned;
            parametric_signal_z += wave.y * turned;
        }
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
