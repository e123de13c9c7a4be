// Spectra of height and displacement D = i k/|k| h, two real fields in each complex one: (h + i Dx, Dz); tiles side by side.
// Divided by the cubic B-spline's response, so that what the transform gives are the coefficients of a spline through the sea.
out vec4 o_spectra;

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    ivec2 k;
    o_spectra = vec4(0.0);
    if (wave_of(ivec2(at.x % SEA_SIZE, at.y), SEA_SIZE, k)) {
        vec2 spline = (2.0 + cos(vec2(k) * (TAU / float(SEA_SIZE)))) / 3.0;
        vec2 h = amplitude(k, at.x / SEA_SIZE, 0.0) / (spline.x * spline.y);
        vec2 way = normalize(vec2(k));
        o_spectra = vec4((1.0 - way.x) * h, way.y * vec2(-h.y, h.x));
    }
}
