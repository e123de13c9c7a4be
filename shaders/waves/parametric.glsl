// Parametric waves y = A u^K, u = (sin theta + 1)/2 (Van Drasek et al. 2010, in Yingst et al. 2011), lowered by their mean; metres.
// theta = phase - k.p; the phase holds time and the eye's place, reduced in float64. Exact to float32 at any time.
uniform vec4 u_parametric[PARAMETRIC_COUNT]; // k.x, k.z (rad/m), A (m), K
uniform float u_parametric_phase[PARAMETRIC_COUNT];
uniform vec3 u_parametric_mean[PARAMETRIC_COUNT]; // of the whole wave: mean square slope, mean of A u^K (m), reach of its orbit over k (m2)
uniform float u_parametric_level; // still water over the troughs of all waves, m

// Sine and cosine of half of theta + pi/2: u is the square of the first, which is 0 at the trough and keeps its digits there.
vec2 parametric_half(float theta) {
    return sine_cosine(0.5 * wrap_phase(theta + 0.5 * PI));
}

// Height over A, and its derivative by theta. kind: 2K where that is a whole number and the power a product; 0: any K.
vec2 parametric_profile(vec2 of_half, float exponent, int kind) {
    float q = abs(of_half.x);
    float slope_sign = of_half.x < 0.0 ? -of_half.y : of_half.y;
    // u^K = q^2K; q^(2K - 1) is what both are made of.
    if (kind > 0) {
        int whole = kind - 1;
        float q2 = q * q;
        float q4 = q2 * q2;
        float q8 = q4 * q4;
        float power = (whole & 1) != 0 ? q : 1.0;
        power *= (whole & 2) != 0 ? q2 : 1.0;
        power *= (whole & 4) != 0 ? q4 : 1.0;
        power *= (whole & 8) != 0 ? q8 : 1.0;
        power *= (whole & 16) != 0 ? q8 * q8 : 1.0;
        power *= (whole & 32) != 0 ? (q8 * q8) * (q8 * q8) : 1.0;
        return vec2(power * q, exponent * power * slope_sign);
    }
    // K < 1/2 has an infinite slope at the trough: held there, in the derivative alone.
    float power = pow(max(q, exponent < 0.5 ? 1e-4 : 1e-30), 2.0 * exponent - 1.0);
    float height = exponent < 0.5 && q < 1e-4 ? (q > 0.0 ? pow(q, 2.0 * exponent) : 0.0) : power * q;
    return vec2(height, exponent * power * slope_sign);
}

int parametric_kind(int i) {
    return PARAMETRIC_ALIKE ? PARAMETRIC_KIND[0] : PARAMETRIC_KIND[i];
}

vec2 parametric_place(int i, vec2 p) {
    return parametric_half(u_parametric_phase[i] - dot(u_parametric[i].xy, p));
}

// Height and its gradient.
vec3 parametric_waves(vec2 p) {
    vec3 sum = vec3(-u_parametric_level, 0.0, 0.0);
    for (int i = 0; i < PARAMETRIC_COUNT; ++i) {
        vec4 wave = u_parametric[i];
        vec2 profile = wave.z * parametric_profile(parametric_place(i, p), wave.w, parametric_kind(i));
        sum += vec3(profile.x, -profile.y * wave.xy);
    }
    return sum;
}

// What fronts read of the place that was shaded last, so that it costs no sine of its own: the waves' sum as an analytic signal (m)
// and its derivatives by x and z. docs/formulae.md, section 4.
vec2 parametric_signal;
vec2 parametric_signal_x;
vec2 parametric_signal_z;

// What carries foam reads of it: the way to where its water rests, m; on land, where no wave is shaded, 0.
vec2 parametric_carried = vec2(0.0);

// Height and gradient without what is smaller than the footprint, and the unresolved mean square slope.
vec4 parametric_shading(vec2 p, Footprint fp) {
    vec4 sum = vec4(0.0);
    parametric_signal = vec2(0.0);
    parametric_signal_x = vec2(0.0);
    parametric_signal_z = vec2(0.0);
    parametric_carried = vec2(0.0);
    for (int i = 0; i < PARAMETRIC_COUNT; ++i) {
        vec4 wave = u_parametric[i];
        vec2 of_half = parametric_place(i, p);
        vec2 profile = wave.z * parametric_profile(of_half, wave.w, parametric_kind(i));
        if (PARAMETRIC_SIGNAL) {
            // Cosine and sine of theta.
            vec2 term = 2.0 * wave.z * of_half.x * of_half.yx - vec2(0.0, wave.z);
            // d theta / d p = -k
            vec2 turned = vec2(term.y, -term.x);
            parametric_signal += term;
            parametric_signal_x += wave.x * turned;
            parametric_signal_z += wave.y * turned;
        }
        float kept = 1.0;
        if (SURFACE_FILTER) {
            kept = wave_kept(wave.xy, fp);
        }
        vec3 mean = u_parametric_mean[i];
        if (PARAMETRIC_CARRIES) {
            parametric_carried += 2.0 * of_half.x * of_half.y * mean.z * wave.xy;
        }
        sum += vec4(kept * (profile.x - mean.y), -kept * profile.y * wave.xy, (1.0 - kept * kept) * mean.x);
    }
    return sum;
}
