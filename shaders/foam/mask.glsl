// How the halftone mask is read: coordinates, single texels, and the filtered texture.

// @part coordinates
// Where a point lies on the mask, in tiles: turned, scaled, and moved by the eye's place (reduced in float64).
uniform vec4 u_mask_matrix; // rows of the turn, over the tile's side (1/m)
uniform vec2 u_mask_offset;

vec2 mask_turn(vec2 p) {
    return vec2(dot(u_mask_matrix.xy, p), dot(u_mask_matrix.zw, p));
}

vec2 mask_uv(vec2 p) {
    return mask_turn(p) + u_mask_offset;
}

// @part carried
// Where a point lies on the mask, in tiles: turned, scaled, moved by the eye's place and back along the drift (reduced in float64).
uniform vec4 u_mask_matrix;  // rows of the turn, over the tile's side (1/m)
uniform float u_mask_phase[2]; // rad, a turn is a tile

vec2 mask_turn(vec2 p) {
    return vec2(dot(u_mask_matrix.xy, p), dot(u_mask_matrix.zw, p));
}

vec2 mask_uv(vec2 p) {
    return mask_turn(p) + vec2(u_mask_phase[0], u_mask_phase[1]) / TAU;
}

// @part exact
// The mask as the paper reads it: one texel, no filter.
float mask_threshold(vec2 p) {
    return mask_texel(as_int(floor(fract(mask_uv(p)) * float(MASK_SIZE))));
}

// @part texel_half
// A mask's threshold (rank + 1/2)/N as a half float: finest where thresholds are small.
uniform sampler2D u_mask_ranks;

float mask_texel(ivec2 texel) {
    return texel_at(u_mask_ranks, texel & (MASK_SIZE - 1)).r;
}

// @part texel_u16
// A mask's threshold (rank + 1/2)/N to 16 bits.
uniform usampler2D u_mask_ranks;

float mask_texel(ivec2 texel) {
    return (float(texel_at(u_mask_ranks, texel & (MASK_SIZE - 1)).r) + 0.5) / 65536.0;
}

// @part texel_u8
// A mask's threshold (rank + 1/2)/N to 8 bits: a 256th of all bubbles pops at once.
uniform usampler2D u_mask_ranks;

float mask_texel(ivec2 texel) {
    return (float(texel_at(u_mask_ranks, texel & (MASK_SIZE - 1)).r) + 0.5) / 256.0;
}

// @part texels
// The foam texture filtered in float32: samplers weigh with some 8 bits.
vec4 bilinear(sampler2D from, vec2 uv, int level) {
    ivec2 size = textureSize(from, level);
    vec2 at = fract(uv) * vec2(size) - 0.5;
    ivec2 low = as_int(floor(at));
    vec2 part = at - vec2(low);
    // Before the wrap from -1 to the size itself.
    ivec2 high = (low + 1) % size;
    low = (low + size) % size;
    vec4 below = mix(texelFetch(from, low, level), texelFetch(from, ivec2(high.x, low.y), level), part.x);
    vec4 above = mix(texelFetch(from, ivec2(low.x, high.y), level), texelFetch(from, high, level), part.x);
    return mix(below, above, part.y);
}

vec4 part_of(sampler2D from, vec2 uv, float wanted, int level) {
    return max(1.0 - abs(wanted - float(level)), 0.0) * bilinear(from, uv, level);
}

// Levels are numbers here: drivers that read one level for four pixels at a time take that of pixels which lie elsewhere.
vec4 trilinear(sampler2D from, vec2 uv, float level) {
    float wanted = min(level, 8.0);
    vec4 fine = part_of(from, uv, wanted, 0) + part_of(from, uv, wanted, 1) + part_of(from, uv, wanted, 2);
    vec4 middle = part_of(from, uv, wanted, 3) + part_of(from, uv, wanted, 4) + part_of(from, uv, wanted, 5);
    return fine + middle + part_of(from, uv, wanted, 6) + part_of(from, uv, wanted, 7) + part_of(from, uv, wanted, 8);
}

// @part texture
// The foam texture, trilinear, its level from the longer side of the footprint.
uniform sampler2D u_foam_texture;
uniform vec2 u_foam_offset; // the eye's place, in tiles
uniform float u_foam_tile;  // 1/m

float foam_texture(vec2 p, Footprint fp) {
    float texels = sqrt(max(dot(fp.x, fp.x), dot(fp.y, fp.y))) * u_foam_tile * float(FOAM_TEXTURE_SIZE);
    float level = max(log2(max(texels, 1e-6)), 0.0);
    return textureLod(u_foam_texture, p * u_foam_tile + u_foam_offset, level).r;
}

// @part texture_pair
// Two copies of the foam texture on tiles without a common measure, the second with u and v swapped (Vlachos), so that they never
// align: their mean. Trilinear, levels from the longer side of the footprint.
uniform sampler2D u_foam_texture;
uniform vec2 u_foam_offset;        // the eye's place, in tiles
uniform float u_foam_tile;         // 1/m
uniform vec2 u_foam_second_offset;
uniform float u_foam_second_tile;

float foam_texture(vec2 p, Footprint fp) {
    float reach = sqrt(max(dot(fp.x, fp.x), dot(fp.y, fp.y))) * float(FOAM_TEXTURE_SIZE);
    float first_level = max(log2(max(reach * u_foam_tile, 1e-6)), 0.0);
    float second_level = max(log2(max(reach * u_foam_second_tile, 1e-6)), 0.0);
    float first = textureLod(u_foam_texture, p * u_foam_tile + u_foam_offset, first_level).r;
    vec2 swapped = (p * u_foam_second_tile + u_foam_second_offset).yx;
    return 0.5 * (first + textureLod(u_foam_texture, swapped, second_level).r);
}
