// What shore waves need to know of a place: r phase (periods), g height (m), b skew (row of the table, 0 to 1), a how much of
// the open sea's waves is left. docs/formulae.md, section 8.
uniform vec2 u_viewport;
uniform sampler2D u_smooth;       // distance (m, positive at sea), depth (m)
uniform float u_shore_size;       // m
uniform float u_shore_deep;       // m
uniform float u_shore_slope;
uniform float u_shore_shelter;    // radius of a lagoon's ring, m; 0: none
uniform float u_surf_height;      // m
uniform float u_surf_period;      // s
uniform float u_surf_variation;
uniform vec2 u_surf_heading;      // unit vector
uniform float u_surf_exposure;
uniform vec2 u_surf_mask[4];      // wavevectors of the mask, rad/m
uniform float u_surf_mask_phase[4];
out vec4 o_map;

vec2 smoothed(ivec2 texel) {
    return texelFetch(u_smooth, clamp(texel, ivec2(0), textureSize(u_smooth, 0) - 1), 0).rg;
}

float smooth_between(float low, float high, float x) {
    float t = clamp((x - low) / max(high - low, 1e-6), 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}

void main() {
    ivec2 here = ivec2(gl_FragCoord.xy);
    vec2 q = (gl_FragCoord.xy / u_viewport - 0.5) * u_shore_size;
    vec2 at = smoothed(here);
    float d = at.x;
    float depth = at.y;

    // Sobel's gradient of the distance: points out to sea; short where coasts on two sides are as near.
    vec2 g = vec2(0.0);
    for (int i = -1; i <= 1; ++i) {
        float weight = i == 0 ? 2.0 : 1.0;
        g.x += weight * (smoothed(here + ivec2(1, i)).x - smoothed(here + ivec2(-1, i)).x);
        g.y += weight * (smoothed(here + ivec2(i, 1)).x - smoothed(here + ivec2(i, -1)).x);
    }
    g *= u_viewport.x / (8.0 * u_shore_size);
    float steep = length(g);
    float ridge = smooth_between(0.3, 0.8, steep);
    float met = dot(-g / max(steep, 1e-6), u_surf_heading);
    float exposed = mix(1.0, smooth_between(-0.3, 0.7, met), u_surf_exposure);
    float open = u_shore_shelter > 0.0 ? smooth_between(0.85 * u_shore_shelter, 1.1 * u_shore_shelter, length(q)) : 1.0;

    float breaks = max(u_surf_height, 0.05) / 0.78;
    float shoal = depth >= breaks ? sqrt(sqrt(breaks / max(depth, breaks))) : 0.3 + 0.7 * smooth_between(0.0, breaks, depth);
    float far = 1.0 - smooth_between(0.45 * u_shore_deep, 0.9 * u_shore_deep, depth);
    float inland = smooth_between(-1.2 * max(u_surf_height, 0.05) / u_shore_slope, 0.0, d);
    float sum = 0.0;
    for (int i = 0; i < 4; ++i) {
        sum += sin(wrap_phase(u_surf_mask_phase[i] + dot(u_surf_mask[i], q)));
    }
    float rhythm = 1.0 - u_surf_variation * smooth_between(-0.8, 0.8, 0.5 * sum);

    // Time to shore over the period, at the speed sqrt(g h) over a floor of even slope.
    float least = max(0.3 * u_surf_height, 0.05);
    float root = sqrt(least);
    float beyond = sqrt(least + u_shore_slope * max(d, 0.0));
    float phase = (2.0 * max(d, 0.0) / (root + beyond) + min(d, 0.0) / root) / (sqrt(9.81) * u_surf_period);

    o_map = vec4(
        phase,
        u_surf_height * shoal * far * inland * ridge * exposed * open * rhythm,
        1.0 - smooth_between(breaks, 2.5 * breaks, depth),
        smooth_between(0.0, 0.6 * u_shore_deep, depth) * mix(0.1, 1.0, open));
}
