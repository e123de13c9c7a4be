// The sea from its spectrum, as it is shaded and found.

// @part sea
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
    return sea_seen(u_sea_seen_0, u_sea_size_0, sea_place_0(p), fp, SEA_SEEN, SEA_FINER)
        + sea_seen(u_sea_seen_1, u_sea_size_1, sea_place_1(p), fp, SEA_SEEN, SEA_FINER);
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

// @part bounds
// Bounds of the two raised tiles as they are now.
uniform sampler2D u_sea_bounds_0;
uniform sampler2D u_sea_bounds_1;

vec3 sea_bounds(vec3 ray, float aside, float from) {
    return texel_at(u_sea_bounds_0, ivec2(0)).xyz + texel_at(u_sea_bounds_1, ivec2(0)).xyz;
}

// @part level
// How many texels of a tile lie under a footprint, as a power of 2: 0 is the tile itself, above SEA_LEVELS nothing of it is left.
float sea_level(float side, Footprint fp) {
    if (!SURFACE_FILTER) {
        return 0.0;
    }
    float longer = sqrt(max(dot(fp.x, fp.x), dot(fp.y, fp.y)));
    float area = abs(fp.x.x * fp.y.y - fp.x.y * fp.y.x);
    float width = area / max(longer, 1e-30);
    // As wide as the footprint's area: by its longer side short waves would go that it tells apart across. Clamped to so many times its
    // width: on a crest's edge a footprint is endlessly long. A trilinear read has three times the variance of a box of its texels:
    // SEA_READ is the root of a third, and more where one sample stands for a pixel, because it sees one of the crests there.
    float side_seen = SEA_READ * min(sqrt(area), 4.0 * width);
    // Two logarithms, of which every tile shares the first.
    return clamp(log2(max(side_seen * float(SEA_SIZE), 1e-6)) - log2(side), -1.0, float(SEA_LEVELS + 1));
}

// @part short
// The second tile of the sea: short waves that ride on those of the first. docs/formulae.md, section 3.
const bool SHORT_WAVES = true;

// Height and its gradient, of the place whose waves were asked for last.
vec3 short_waves() {
    return sea_short;
}

// @part short_bounds
// Of the second tile as it is now.
vec3 short_bounds() {
    return texel_at(u_sea_bounds_1, ivec2(0)).xyz;
}

// @part detail_one
// The smallest tile of open sea: slopes without height.
uniform sampler2D u_sea_seen_2;
uniform float u_sea_size_2;  // side, m
uniform vec2 u_sea_offset_2; // the eye's place in the tile, in tiles

vec2 sea_place_2(vec2 p) {
    return p / u_sea_size_2 + u_sea_offset_2;
}

// Gradient, and the unresolved mean square slope.
vec3 sea_detail(vec2 p, Footprint fp) {
    return sea_seen(u_sea_seen_2, u_sea_size_2, sea_place_2(p), fp, SEA_DETAIL, SEA_DETAIL_FINER).xyz;
}

// @part detail_two
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
    return sea_seen(u_sea_seen_2, u_sea_size_2, sea_place_2(p), fp, SEA_DETAIL, SEA_DETAIL_FINER).xyz
        + sea_seen(u_sea_seen_3, u_sea_size_3, sea_place_3(p), fp, SEA_DETAIL, SEA_DETAIL_FINER).xyz;
}

// @part seen
// What a footprint sees of a tile of sea, which seen_pass or seen_same_pass drew: mean slopes, the unresolved mean square slope, mean divergence.
// side: of the tile (m); at: place in it, in tiles; texels: along it; finer: log2 of those for each of the height field's.
vec4 sea_seen(sampler2D tile, float side, vec2 at, Footprint fp, int texels, float finer) {
    float level = max(sea_level(side, fp) + finer, 0.0);
    vec4 here = textureLod(tile, at + 0.5 / float(texels), level);
    // Everything is resolved between two texels; what the sampler takes out there is its own error.
    float unresolved = min(level, 1.0) * max(here.z - dot(here.xy, here.xy), 0.0);
    return vec4(here.xy, unresolved, here.w);
}

// @part seen_exact
// A tile of sea at a place: slopes, nothing unresolved, divergence. side: of the tile (m); at: place in it, in tiles.
vec4 sea_seen(sampler2D tile, float side, vec2 at, Footprint fp, int texels, float finer) {
    vec4 here = sea_smooth(tile, at);
    return vec4(here.yz, 0.0, here.w);
}

// @part seen_pass
// A tile as footprints see it: slopes, their square, divergence. At and between its texels by the B-spline; the levels below it
// are means over more and more of them.
uniform sampler2D u_sea_full;
out vec4 o_seen;

void main() {
    vec4 here = sea_smooth(u_sea_full, floor(gl_FragCoord.xy) / float(SEA_DETAIL));
    o_seen = vec4(here.yz, dot(here.yz, here.yz), here.w);
}

// @part seen_same_pass
// A tile as footprints see it, of as many texels: slopes, their square, divergence; the levels below it are means.
uniform sampler2D u_sea_full;
out vec4 o_seen;

void main() {
    vec4 here = textureLod(u_sea_full, gl_FragCoord.xy / float(SEA_SEEN), 0.0);
    o_seen = vec4(here.yz, dot(here.yz, here.yz), here.w);
}
