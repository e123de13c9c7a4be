// Parameters of the map of what shore waves need to know of a place, and its smooth distances. docs/formulae.md, section 8.
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

vec2 smoothed(ivec2 texel) {
    return texel_at(u_smooth, clamp(texel, ivec2(0), textureSize(u_smooth, 0) - 1)).rg;
}

float smooth_between(float low, float high, float x) {
    float t = clamp((x - low) / max(high - low, 1e-6), 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}
