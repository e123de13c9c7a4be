// The two smallest tiles of open sea: slopes without height.
uniform sampler2D u_sea_tile_2;
uniform sampler2D u_sea_tile_3;

// Gradient, and the mean square slope taken out.
vec3 sea_detail(vec2 p, Footprint fp) {
    vec4 longer = sea_seen(u_sea_tile_2, 2, p, sea_level(2, fp));
    vec4 shorter = sea_seen(u_sea_tile_3, 3, p, sea_level(3, fp));
    return vec3(longer.xy + shorter.xy, sea_lost(longer) + sea_lost(shorter));
}
