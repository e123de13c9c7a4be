// A floor laid with square tiles, each a little lighter or darker than the next, and pale joints between
// them. Joints are averaged exactly over the box that holds the footprint; at: m from the eye.
uniform float u_floor_tile;       // side of a tile, m
uniform vec2 u_floor_tile_place;  // the eye's place among 256 by 256 tiles

const uint TILE_KEY = 0x9E3779B9u;
const float JOINT = 0.05;         // width of a joint, in tiles
const float JOINT_ALBEDO = 0.72;

// Width of the joints left of x; a joint ends every tile.
vec2 joints_before(vec2 x) {
    return JOINT * floor(x) + max(fract(x) - (1.0 - JOINT), 0.0);
}

vec3 bed_albedo(vec2 at, Footprint fp) {
    vec2 x = at / u_floor_tile + u_floor_tile_place;
    // Narrower than a thousandth of a tile the difference below would be rounding.
    vec2 width = max((abs(fp.x) + abs(fp.y)) / u_floor_tile, 1e-3);
    vec2 open = 1.0 - (joints_before(x + 0.5 * width) - joints_before(x - 0.5 * width)) / width;
    float shade = noise_corner(TILE_KEY, ivec2(floor(x)) & 255) - 0.5;
    shade *= 1.0 - smoothstep(0.5, 1.5, max(width.x, width.y));
    return mix(vec3(JOINT_ALBEDO), u_floor_albedo * (1.0 + 0.24 * shade), clamp(open.x * open.y, 0.0, 1.0));
}
