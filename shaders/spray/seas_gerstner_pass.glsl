// Height, displacement and divergence of a tile's waves when each batch of drops was born, as coefficients of a cubic B-spline:
// (h, Dx, Dz, F), F = l div D.
uniform vec2 u_spray_scale;  // l 2 pi / side of the first and second tile, rad/m
uniform float u_spray_time[2];
uniform float u_spray_step;
out vec4 o_sea;

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    ivec2 waves = gerstner_waves(at.x / SPRAY_TEXELS);
    float scale = at.x < SPRAY_TEXELS ? u_spray_scale.x : u_spray_scale.y;
    float before = u_spray_time[0] + float(at.y / SPRAY_TEXELS) * u_spray_step;
    o_sea = vec4(0.0);
    for (int i = waves.x; i < waves.y; ++i) {
        vec4 wave = u_gerstner[i];
        vec2 turn = whole_sine_cosine(wrap_phase(gerstner_theta(i, at % SPRAY_TEXELS, SPRAY_TEXELS) + wave.w * before));
        float number = length(wave.xy);
        o_sea += wave.z * vec4(turn.y, -turn.x * wave.xy / number, -scale * number * turn.y);
    }
}
