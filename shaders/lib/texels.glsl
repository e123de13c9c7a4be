// Reads of textures: single texels, bilinear, the cubic B-spline, a cube's faces.

// @part as_int
// A whole number in [-2^22, 2^22] as int: added to 1.5 * 2^23, it is the last bits of the sum. By a conversion llvmpipe of Mesa 25 takes one lane
// after the other, sixty instructions in all.
int as_int(float x) {
    return floatBitsToInt(x + 12582912.0) - 0x4B400000;
}

ivec2 as_int(vec2 x) {
    return floatBitsToInt(x + 12582912.0) - 0x4B400000;
}

ivec3 as_int(vec3 x) {
    return floatBitsToInt(x + 12582912.0) - 0x4B400000;
}

// @part as_bits
// The same plus a multiple of 2^22, for whole numbers of which the last bits are taken: an instruction less.
ivec2 as_bits(vec2 x) {
    return floatBitsToInt(x + 12582912.0);
}

ivec3 as_bits(vec3 x) {
    return floatBitsToInt(x + 12582912.0);
}

// @part texel
// A texel of a texture that is read by its nearest, as by texelFetch: llvmpipe takes up to three times as long for that, GPUs some
// twenty instructions more for this. So what is drawn for each sample and each step of a ray reads by this.
vec4 texel_at(sampler2D from, ivec2 at) {
    vec2 side = 1.0 / vec2(textureSize(from, 0));
    return textureLod(from, vec2(at) * side + 0.5 * side, 0.0);
}

uvec4 texel_at(usampler2D from, ivec2 at) {
    vec2 side = 1.0 / vec2(textureSize(from, 0));
    return textureLod(from, vec2(at) * side + 0.5 * side, 0.0);
}

// @part layer_texel
// The same of an array of textures. at.z: the layer.
precision highp sampler2DArray;

vec4 texel_at(sampler2DArray from, ivec3 at) {
    vec2 side = 1.0 / vec2(textureSize(from, 0).xy);
    return textureLod(from, vec3(vec2(at.xy) * side + 0.5 * side, float(at.z)), 0.0);
}

// @part bilinear
// Bilinear reads in float32: samplers weigh texels in 256 steps, and not every device filters float textures.

// a, b: of one row; c, d: of the next; t: in [0, 1], along the rows and across.
vec4 bilinear(vec4 a, vec4 b, vec4 c, vec4 d, vec2 t) {
    return mix(mix(a, b, t.x), mix(c, d, t.x), t.y);
}

// Between the columns and rows of two texels, wherever these are. Row by row: four texels at once would take more registers.
vec4 bilinear_between(sampler2D map, ivec2 first, ivec2 next, vec2 t) {
    vec4 row = mix(texel_at(map, first), texel_at(map, ivec2(next.x, first.y)), t.x);
    return mix(row, mix(texel_at(map, ivec2(first.x, next.y)), texel_at(map, next), t.x), t.y);
}

// From a periodic block of a map. corner: its first texel; size: its side, a power of 2; at: place in it, texel j is at j.
vec4 bilinear_wrapped(sampler2D map, ivec2 corner, int size, vec2 at) {
    vec2 base = floor(at);
    ivec2 first = as_int(base) & (size - 1);
    return bilinear_between(map, corner + first, corner + ((first + 1) & (size - 1)), at - base);
}

// From a square map, held at its rim. at: place in it, texel j is at j.
vec4 bilinear_held(sampler2D map, int size, vec2 at) {
    at = clamp(at, 0.0, float(size - 1));
    ivec2 first = min(as_int(floor(at)), size - 2);
    return bilinear_between(map, first, first + 1, at - vec2(first));
}

// @part cubic_spline
// The uniform cubic B-spline between the second and the third of four coefficients, t in [0, 1]: weights, and those of its first and
// second derivative.
vec4 spline_weights(float t) {
    float u = 1.0 - t;
    return vec4(u * u * u, (3.0 * t - 6.0) * t * t + 4.0, (3.0 * u - 6.0) * u * u + 4.0, t * t * t) / 6.0;
}

vec4 spline_slopes(float t) {
    float u = 1.0 - t;
    return 0.5 * vec4(-u * u, (3.0 * t - 4.0) * t, (4.0 - 3.0 * u) * u, t * t);
}

vec4 spline_bends(float t) {
    float u = 1.0 - t;
    return vec4(u, 3.0 * t - 2.0, 3.0 * u - 2.0, t);
}

// @part cube_face
// The face of a cube that a direction meets: +x, -x, +y, -y, +z, -z. x and y along the face's sides, z toward it.
vec3 cube_face(vec3 d, out int face) {
    vec3 size = abs(d);
    if (size.x >= size.y && size.x >= size.z) {
        face = d.x > 0.0 ? 0 : 1;
        return vec3(d.y, d.z, size.x);
    }
    if (size.y >= size.z) {
        face = d.y > 0.0 ? 2 : 3;
        return vec3(d.z, d.x, size.y);
    }
    face = d.z > 0.0 ? 4 : 5;
    return vec3(d.x, d.y, size.z);
}
