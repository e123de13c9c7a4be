// The two smallest tiles of open sea: slopes without height.
uniform sampler2D u_sea_tile_2;
uniform sampler2D u_sea_tile_3;
uniform vec3 u_sea_size_2;   // side (m), mean square slope, mean fold
uniform vec2 u_sea_offset_2; // the eye's place in the tile, in tiles
uniform vec3 u_sea_size_3;   // side (m), mean square slope, mean fold
uniform vec2 u_sea_offset_3; // the eye's place in the tile, in tiles

vec2 sea_place_2(vec2 p) {
    return p / u_sea_size_2.x + u_sea_offset_2;
}

vec2 sea_place_3(vec2 p) {
    return p / u_sea_size_3.x + u_sea_offset_3;
}

// Gradient, and the mean square slope taken out.
vec3 sea_detail(vec2 p, Footprint fp) {
    vec4 longer = sea_seen(u_sea_tile_2, 2, u_sea_size_2, sea_place_2(p), fp);
    vec4 shorter = sea_seen(u_sea_tile_3, 3, u_sea_size_3, sea_place_3(p), fp);
    return vec3(longer.xy + shorter.xy, sea_lost(longer) + sea_lost(shorter));
}
