// A level floor: its tiles, caustics, and light through the water.

// @part body
// Water over a level floor that is lit by itself: its light comes up along the refracted ray.
vec3 bed_seen = vec3(0.0); // radiance of the floor; set before the water is shaded
float bed_way = 0.0;       // from the floor up to the eye's ray, m
float bed_down = 0.0;      // straight down to it, m

vec3 water_body(vec3 below, vec3 deep, vec3 extinction, float cv, float height) {
    return deep * (1.0 - exp(-extinction * (bed_way + bed_down))) + bed_seen * exp(-extinction * bed_way);
}

// @part level
// A level floor.
uniform vec3 u_floor_albedo;
uniform float u_floor_depth; // under still water, m

// @part even
// The sun's light on the floor where nothing focuses it, over that on a level surface.
vec3 bed_sunlight(vec2 at, Footprint fp) {
    return vec3(1.0);
}

// @part plain
// A bare floor.
vec3 bed_albedo(vec2 at, Footprint fp) {
    return u_floor_albedo;
}

// @part reach
// Way to the level floor along d (unit) from a place at height y, m; 0 under the floor.
float bed_reach(vec2 p, float y, vec3 d) {
    return min(max(u_floor_depth + y, 0.0) / max(-d.y, 1e-6), 1e6);
}

// @part tiles
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
    float shade = noise_corner(TILE_KEY, as_int(floor(x)) & 255) - 0.5;
    shade *= 1.0 - smoothstep(0.5, 1.5, max(width.x, width.y));
    return mix(vec3(JOINT_ALBEDO), u_floor_albedo * (1.0 + 0.24 * shade), clamp(open.x * open.y, 0.0, 1.0));
}

// @part floor
// A floor, lit through the water by sun and sky. docs/formulae.md, section 11.
uniform float u_bed_sun; // cosine of the sun's ray in the water to the vertical

// Radiance of the floor at a place (m from the eye), `down` metres under the surface.
vec3 bed_light(vec2 at, float down, Footprint fp) {
    vec3 extinction = 1.0 / u_absorption_length + u_scattering;
    // Where the sun's ray enters level water.
    vec2 enters = at + down / (INDEX * u_bed_sun) * u_sun_direction.xz;
    vec3 sun = u_sun_irradiance * (sunlit(vec3(enters.x, 0.0, enters.y), fp) * max(u_sun_direction.y, 0.0))
        * bed_sunlight(at, fp) * exp(-extinction * (down / u_bed_sun));
    vec3 sky = u_sky_irradiance * exp(-extinction * down);
    return 0.95 / PI * bed_albedo(at, fp) * (sun + sky);
}

// @part caustics
// The sun's light on the floor, focused by the ripples: the caustic map, over the light on a level surface. Read bilinearly;
// under a footprint (`surface.filter`) the mean of four places in it, in means of texels half as wide as the footprint.
uniform sampler2D u_caustics;
uniform vec2 u_caustic_place; // the eye's place in the tile, less the way of the light down to the floor, in tiles
uniform float u_caustic_tile; // m

vec3 caustic_at(vec2 at, float level) {
    return textureLod(u_caustics, at / u_caustic_tile + u_caustic_place, level).rgb;
}

vec3 bed_sunlight(vec2 at, Footprint fp) {
    if (!SURFACE_FILTER) {
        return caustic_at(at, 0.0);
    }
    float side = sqrt(0.5 * (dot(fp.x, fp.x) + dot(fp.y, fp.y)));
    float level = log2(max(0.5 * side * float(CAUSTIC_TEXELS) / u_caustic_tile, 1.0));
    return 0.25 * (caustic_at(at + 0.25 * (fp.x + fp.y), level) + caustic_at(at + 0.25 * (fp.x - fp.y), level)
        + caustic_at(at - 0.25 * (fp.x + fp.y), level) + caustic_at(at - 0.25 * (fp.x - fp.y), level));
}

// @part through
// The level floor along the ray refracted at the surface. Ripples that face away are taken edge-on; none may tilt it level.
void look_through(vec2 p, float height, vec3 d, vec3 normal, float unresolved, Footprint fp) {
    float c = max(-dot(normal, d), 0.0);
    vec3 down = refracted(d, normal, c, INDEX);
    // A trough may reach the floor.
    bed_down = max(u_floor_depth + height, 0.0);
    bed_way = bed_down / max(-down.y, 0.25);
    // What the footprint took out of the surface bends the ray by a third of its slope.
    float blur = 0.34 * sqrt(unresolved) * bed_way;
    Footprint seen = Footprint(fp.x + vec2(blur, 0.0), fp.y + vec2(0.0, blur));
    bed_seen = bed_light(p + bed_way * down.xz, bed_down, seen);
}
