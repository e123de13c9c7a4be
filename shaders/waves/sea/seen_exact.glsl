// A tile of sea at a place: slopes, nothing unresolved, divergence. side: of the tile (m); at: place in it, in tiles.
vec4 sea_seen(sampler2D tile, float side, vec2 at, Footprint fp) {
    vec4 here = sea_smooth(tile, at);
    return vec4(here.yz, 0.0, here.w);
}
