// Spectra of the sea when each batch of drops was born: (h + i Dx, Dz + i F), F = l div D = -l |k| h; tiles side by side, batches over one
// another. Divided by the cubic B-spline's response.
uniform vec2 u_spray_scale;  // l 2 pi / side of the first and second tile, rad/m
uniform float u_spray_time[2];
uniform float u_spray_step;
out vec4 o_spectra;

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    int tile = at.x / SPRAY_TEXELS;
    ivec2 k;
    o_spectra = vec4(0.0);
    if (wave_of(at % SPRAY_TEXELS, SPRAY_TEXELS, k)) {
        vec2 spline = (2.0 + cos(vec2(k) * (TAU / float(SPRAY_TEXELS)))) / 3.0;
        vec2 h = amplitude(k, tile, u_spray_time[0] + float(at.y / SPRAY_TEXELS) * u_spray_step) / (spline.x * spline.y);
        float number = length(vec2(k));
        vec2 way = vec2(k) / number;
        float second = way.y - number * (tile == 0 ? u_spray_scale.x : u_spray_scale.y);
        o_spectra = vec4((1.0 - way.x) * h, second * vec2(-h.y, h.x));
    }
}
