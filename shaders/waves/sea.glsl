// Open sea: the two largest tiles raise and lower the surface; metres.
uniform sampler2D u_sea_tile_0;
uniform sampler2D u_sea_tile_1;
uniform sampler2D u_sea_seen_0;
uniform sampler2D u_sea_seen_1;
uniform float u_sea_size_0;  // side, m
uniform vec2 u_sea_offset_0; // the eye's place in the tile, in tiles
uniform float u_sea_size_1;  // side, m
uniform vec2 u_sea_offset_1; // the eye's place in the tile, in tiles

vec2 sea_place_0(vec2 p) {
    return p / u_sea_size_0 + u_sea_offset_0;
}

vec2 sea_place_1(vec2 p) {
    return p / u_sea_size_1 + u_sea_offset_1;
}

// The second tile's share of the waves that were asked for last.
vec3 sea_short;

// Height and its gradient.
vec3 sea_waves(vec2 p) {
    sea_short = sea_fetch(u_sea_tile_1, sea_place_1(p)).xyz;
    return sea_fetch(u_sea_tile_0, sea_place_0(p)).xyz + sea_short;
}

// The raised tiles under a footprint, added up, slopes, unresolved mean square slope, divergence.
vec4 sea_resolved(vec2 p, Footprint fp) {
    return sea_seen(u_sea_seen_0, u_sea_size_0, sea_place_0(p), fp) + sea_seen(u_sea_seen_1, u_sea_size_1, sea_place_1(p), fp);
}

// The same of the place that was shaded last: foam there need not read it again.
vec4 sea_shaded;

// Height and gradient without what is smaller than the footprint, and the unresolved mean square slope.
vec4 sea_shading(vec2 p, Footprint fp) {
    float height = 0.0;
    float kept = clamp(0.5 * (float(SEA_LEVELS + 1) - sea_level(u_sea_size_0, fp)), 0.0, 1.0);
    height += kept * sea_fetch(u_sea_tile_0, sea_place_0(p)).x;
    kept = clamp(0.5 * (float(SEA_LEVELS + 1) - sea_level(u_sea_size_1, fp)), 0.0, 1.0);
    height += kept * sea_fetch(u_sea_tile_1, sea_place_1(p)).x;
    sea_shaded = sea_resolved(p, fp);
    return vec4(height, sea_shaded.xyz);
}
