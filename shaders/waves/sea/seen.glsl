// What a footprint sees of a tile of sea, which seen_pass.glsl drew: mean slopes, the unresolved mean square slope, mean divergence.
// side: of the tile (m); at: place in it, in tiles.
vec4 sea_seen(sampler2D tile, float side, vec2 at, Footprint fp) {
    float level = sea_level(side, fp) + 1.0;
    vec4 here = textureLod(tile, at + 0.25 / float(SEA_SIZE), level);
    // Everything is resolved between two texels; what the sampler takes out there is its own error.
    float unresolved = min(level, 1.0) * max(here.z - dot(here.xy, here.xy), 0.0);
    return vec4(here.xy, unresolved, here.w);
}
