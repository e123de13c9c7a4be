// The smallest tile of open sea: slopes without height.
uniform sampler2D u_sea_tile_2;

// Gradient, and the mean square slope taken out.
vec3 sea_detail(vec2 p, Footprint fp) {
    vec4 seen = sea_seen(u_sea_tile_2, 2, p, sea_level(2, fp));
    return vec3(seen.xy, sea_lost(seen));
}
