// Divergence l div D of the waves, -l sum of a k cos(theta), at four earlier times; each four times a row of blocks.
uniform vec2 u_age_scale; // l 2 pi / side, rad/m
uniform float u_age_step; // s
uniform float u_age_from; // s before the first of them
uniform vec4 u_age_drift; // of the foam, rad/s a wave along the first and second tile
out vec4 o_divergence;

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    vec4 before = u_age_from + u_age_step * (float(at.y / AGE_SIZE * 4) + vec4(1.0, 2.0, 3.0, 4.0));
    o_divergence = vec4(0.0);
    ivec2 waves = gerstner_waves(at.x / AGE_SIZE);
    float scale = at.x < AGE_SIZE ? u_age_scale.x : u_age_scale.y;
    for (int i = waves.x; i < waves.y; ++i) {
        vec4 wave = u_gerstner[i];
        float theta = gerstner_theta(i, at % AGE_SIZE, AGE_SIZE);
        float rate = wave.w;
        if (AGE_DRIFTS) {
            rate -= dot(wave.xy, at.x < AGE_SIZE ? u_age_drift.xy : u_age_drift.zw);
        }
        vec4 angle = theta + rate * before;
        o_divergence -= scale * length(wave.xy) * wave.z
            * vec4(cos(wrap_phase(angle.x)), cos(wrap_phase(angle.y)), cos(wrap_phase(angle.z)), cos(wrap_phase(angle.w)));
    }
}
