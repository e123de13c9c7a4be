// Spectra of the divergence F = l div D = -l |k| h at four earlier times: (F1 + i F2, F3 + i F4). Tiles side by side, each
// four times a row of blocks.
uniform vec2 u_age_scale; // l 2 pi / side of the first and second tile, rad/m
uniform float u_age_step; // s
uniform float u_age_from; // s before the first of them
uniform vec4 u_age_drift; // of the foam, rad/s a wave along the first and second tile
out vec4 o_spectra;

// Of the water that has drifted here since.
vec2 divergence_then(ivec2 k, int tile, float before) {
    vec2 then = amplitude(k, tile, before);
    if (!AGE_DRIFTS) {
        return then;
    }
    float angle = -before * dot(vec2(k), tile == 0 ? u_age_drift.xy : u_age_drift.zw);
    return complex_product(then, vec2(cos(angle), sin(angle)));
}

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    int tile = at.x / AGE_SIZE;
    ivec2 k;
    o_spectra = vec4(0.0);
    if (wave_of(at % AGE_SIZE, AGE_SIZE, k)) {
        float scale = -(tile == 0 ? u_age_scale.x : u_age_scale.y) * length(vec2(k));
        float first = float(at.y / AGE_SIZE * 4);
        vec2 a = divergence_then(k, tile, u_age_from + (first + 1.0) * u_age_step);
        vec2 b = divergence_then(k, tile, u_age_from + (first + 2.0) * u_age_step);
        vec2 c = divergence_then(k, tile, u_age_from + (first + 3.0) * u_age_step);
        vec2 d = divergence_then(k, tile, u_age_from + (first + 4.0) * u_age_step);
        o_spectra = scale * vec4(a.x - b.y, a.y + b.x, c.x - d.y, c.y + d.x);
    }
}
