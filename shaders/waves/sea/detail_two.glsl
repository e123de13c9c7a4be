// The two smallest tiles of open sea: slopes without height.
uniform sampler2D u_sea_seen_2;
uniform sampler2D u_sea_seen_3;
uniform float u_sea_size_2;  // side, m
uniform vec2 u_sea_offset_2; // the eye's place in the tile, in tiles
uniform float u_sea_size_3;  // side, m
uniform vec2 u_sea_offset_3; // the eye's place in the tile, in tiles

vec2 sea_place_2(vec2 p) {
    return p / u_sea_size_2 + u_sea_offset_2;
}

vec2 sea_place_3(vec2 p) {
    return p / u_sea_size_3 + u_sea_offset_3;
}

// Gradient, and the unresolved mean square slope.
vec3 sea_detail(vec2 p, Footprint fp) {
    return sea_seen(u_sea_seen_2, u_sea_size_2, sea_place_2(p), fp).xyz + sea_seen(u_sea_seen_3, u_sea_size_3, sea_place_3(p), fp).xyz;
}
