// What the surface never exceeds, declared and measured.

// @part declared
// Bounds that the scene alone states: height over y = 0 (m), slope, second derivative (1/m).
uniform vec3 u_surface_bounds;

vec3 declared_bounds(vec3 ray, float aside, float from) {
    return u_surface_bounds;
}

// @part pass
// What a map of waves holds at most in blocks of its texels: height (m), slope, second derivative where troughs turn up (1/m).
// From its slopes' differences. docs/formulae.md, section 3.
uniform sampler2D u_bounded; // height, slopes along x and z
uniform float u_bounded_texel; // m
out vec4 o_bounds;

void main() {
    ivec2 size = textureSize(u_bounded, 0);
    ivec2 corner = as_int(floor(gl_FragCoord.xy)) * BOUNDS_BLOCK;
    vec3 bounds = vec3(-65000.0, 0.0, 0.0);
    for (int j = 0; j < BOUNDS_BLOCK.y; j += BOUNDS_STRIDE) {
        for (int i = 0; i < BOUNDS_BLOCK.x; i += BOUNDS_STRIDE) {
            ivec2 at = corner + ivec2(i, j);
            ivec2 next = (at + 1) & (size - 1);
            vec3 here = texelFetch(u_bounded, at, 0).xyz;
            vec3 along_x = texelFetch(u_bounded, ivec2(next.x, at.y), 0).xyz - here;
            vec3 along_z = texelFetch(u_bounded, ivec2(at.x, next.y), 0).xyz - here;
            // The greater eigenvalue of the second derivatives.
            float half_sum = 0.5 * (along_x.y + along_z.z);
            float half_difference = 0.5 * (along_x.y - along_z.z);
            float mixed = 0.5 * (along_x.z + along_z.y);
            float bend = half_sum + sqrt(half_difference * half_difference + mixed * mixed);
            float steep = max(length(here.yz), length(vec2(along_x.x, along_z.x)) / u_bounded_texel);
            bounds = max(bounds, vec3(here.x, steep, bend / u_bounded_texel));
        }
    }
    o_bounds = vec4(bounds, 0.0);
}

// @part join
// The greatest of all blocks.
uniform sampler2D u_blocks;
out vec4 o_bounds;

void main() {
    ivec2 size = textureSize(u_blocks, 0);
    vec3 bounds = vec3(-65000.0, 0.0, 0.0);
    for (int j = 0; j < size.y; ++j) {
        for (int i = 0; i < size.x; ++i) {
            bounds = max(bounds, texel_at(u_blocks, ivec2(i, j)).xyz);
        }
    }
    // A little more: texels are read bilinearly, and half floats are rounded.
    o_bounds = min(vec4(bounds.x + 1e-3 * abs(bounds.x), 1.02 * bounds.y, 1.1 * bounds.z, 0.0), 65000.0);
}

// @part now_declared
// What the scene alone states of the surface.
uniform float u_surface_steepest;

// Height of the highest crest, m: what the scene states is in u_surface_top.
float surface_top_now() {
    return 1e30;
}

// Slope at most; how high the short waves stand at most (m), and their second derivative (1/m), where they are told apart.
vec3 surface_now() {
    return vec3(u_surface_steepest, 0.0, 0.0);
}

// @part now_measured
// What the frame has measured of the surface.
uniform sampler2D u_surface_now;

// Height of the highest crest, m.
float surface_top_now() {
    return texel_at(u_surface_now, ivec2(0)).a;
}

// Slope at most; how high the short waves stand at most (m), and their second derivative (1/m), where they are told apart.
vec3 surface_now() {
    return texel_at(u_surface_now, ivec2(0)).xyz;
}

// @part now_pass
// What marches read of the surface's bounds as they are now: slope; the short waves' height and second derivative; top.
out vec4 o_now;

void main() {
    vec3 few = short_bounds();
    vec3 bounds = surface_bounds(vec3(0.0), 0.0, 0.0);
    // Half floats: what is added is rounded up, what is taken away is rounded down.
    o_now = vec4(1.001 * bounds.y, 1.001 * few.x, 0.999 * few.z, bounds.x + 0.001 * abs(bounds.x));
}

// @part pyramid
// tau before which the tile's rays are known to be free, of water and of land over y = 0.
vec2 pyramid_free = vec2(0.0);

// The rays of a tile of the picture, between ray - side - top and ray + side + top.
struct Pyramid {
    float aside;  // how far from the middle ray they are at most, m a unit: level
    float raised; // and upright
    float speed;  // m a unit, level, of the fastest
    float reach;  // tau beyond which nothing is looked for
};

Pyramid pyramid(vec3 ray, vec3 side, vec3 top) {
    float aside = length(side.xz) + length(top.xz);
    float speed = length(ray.xz) + aside;
    return Pyramid(aside, abs(side.y) + abs(top.y), speed, 1e5 / max(speed, 1e-6 * length(ray)));
}

// tau at which the first of the rays comes to a level that the eye is `over` metres over (0: it is beyond); toward: m a unit.
float pyramid_enters(Pyramid rays, float over, float toward) {
    return over > 0.0 ? (toward > 0.0 ? over / toward : rays.reach) : 0.0;
}
