// Open sea on a single tile. Heights are counted from the lowest that the tile holds; m.
uniform sampler2D u_sea_tile_0;
uniform float u_sea_level; // m
uniform vec3 u_sea_size_0;   // side (m), mean square slope, mean fold
uniform vec2 u_sea_offset_0; // the eye's place in the tile, in tiles

vec2 sea_place_0(vec2 p) {
    return p / u_sea_size_0.x + u_sea_offset_0;
}

// Height and its gradient.
vec3 sea_waves(vec2 p) {
    vec3 sum = sea_fetch(u_sea_tile_0, sea_place_0(p)).xyz;
    return vec3(u_sea_level + sum.x, sum.yz);
}

// The tile under a footprint, with the mean square slope that it lost: slopes, lost, fold.
vec4 sea_folds(vec2 p, Footprint fp) {
    vec4 seen = sea_seen(u_sea_tile_0, 0, u_sea_size_0, sea_place_0(p), fp);
    return vec4(seen.xy, sea_lost(seen), seen.w);
}

// Height and gradient with what is smaller than the footprint taken out, and the mean square slope taken out.
vec4 sea_shading(vec2 p, Footprint fp) {
    float kept = clamp(0.5 * (float(SEA_LEVELS + 1) - sea_level(u_sea_size_0, fp)), 0.0, 1.0);
    float height = kept * sea_fetch(u_sea_tile_0, sea_place_0(p)).x;
    return vec4(u_sea_level + height, sea_folds(p, fp).xyz);
}
