// Gusts run over the ripples: gradient noise that moves with the wind and changes as it goes. docs/formulae.md, section 9. The place is
// reduced in float64; the noise repeats after 256 cells.
uniform float u_gust_phase[3]; // the eye's place in the noise: x, z, time; rad, a turn is 256 cells
uniform float u_gust_size;     // m
uniform float u_gust_strength;

vec3 ripples_detail(vec2 p, Footprint fp) {
    vec3 place = vec3(u_gust_phase[0], u_gust_phase[1], u_gust_phase[2]) * 40.7436654315252 + vec3(p / u_gust_size, 0.0);
    float width = SURFACE_FILTER ? sqrt(max(dot(fp.x, fp.x), dot(fp.y, fp.y))) / u_gust_size : 0.0;
    float gust = 1.0 + u_gust_strength * clamp(0.8 * fractal_3(place, width, 3, uint(GUST_SEED)), -1.0, 1.0);
    vec3 even = even_detail(p, fp);
    return vec3(gust * even.xy, gust * gust * even.z);
}
