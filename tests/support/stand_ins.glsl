// What stands in for functions that the tested ones call, and gives what a test sets.

// @part one_texture
float foam_texture(vec2 p, Footprint fp) { return 1.0; }

// @part given_look
vec4 given;
float mask_threshold(vec2 p) { return given.y; }
float foam_texture(vec2 p, Footprint fp) { return given.z; }

// @part given_mask
vec4 given;
vec2 mask_uv(vec2 p) { return given.yz; }
vec2 mask_turn(vec2 p) { return p; }
float foam_texture(vec2 p, Footprint fp) { return 1.0; }

// A sum of waves that is all but 0, and that changes by 1 a metre.
// @part no_phase
uniform float u_eye_height;
vec2 front_signal(vec2 p, out vec2 by_x, out vec2 by_z) {
    by_x = vec2(0.0, 1.0);
    by_z = vec2(0.0);
    return vec2(1e-9);
}

// @part given_slope
vec4 given;
vec4 waves_shading(vec2 p, Footprint fp) { return given; }

// @part parametric_slope
vec4 waves_shading(vec2 p, Footprint fp) { return parametric_shading(p, fp); }

// A shore whose waves come from nowhere.
// @part no_field
uniform float u_shore_size;
struct ShoreField {
    vec4 here;
    vec4 along_x;
    vec4 along_z;
};
ShoreField shore_field(vec2 q) { return ShoreField(vec4(0.0, 1.0, 0.0, 0.0), vec4(0.0), vec4(0.0)); }
vec2 shore_place(vec2 p) { return p; }
vec3 open_waves(vec2 p) { return vec3(0.0); }
vec4 open_shading(vec2 p, Footprint fp) { return vec4(0.0); }
vec3 bspline_weights(float t) { return vec3(0.0, 1.0, 0.0); }
vec3 bspline_slopes(float t) { return vec3(0.0); }

// @part edge
uniform float u_surf_life;
vec2 shore_tilt = vec2(0.0);
struct ShoreField {
    vec4 here;
    vec4 along_x;
    vec4 along_z;
};
float surf_swept(ShoreField f, float ground, float patches, Footprint fp) { return 0.0; }

// @part foam_in_the_sun
uniform vec3 u_sun_direction;
uniform vec3 u_sun_irradiance;
uniform vec3 u_sky_irradiance;
vec2 sun_past_foam = vec2(1.0);
float widest = 0.0;
float foam_amount(float f, vec2 p, Footprint fp) {
    widest = max(length(fp.x), length(fp.y));
    return f;
}

// @part sun
uniform vec3 u_sun_direction;
uniform vec3 u_sun_irradiance;

// @part no_glint
uniform vec3 u_sun_irradiance;
vec3 smooth_glitter(vec3 d, vec3 n, float s, float c) { return vec3(0.0); }

// @part course
uniform vec4 u_boat_course[1];
uniform vec4 u_boat_form[1];

// @part deep
vec2 shore_place(vec2 p) { return p; }
vec4 shore_floor(vec2 q) { return vec4(-2.0, 0.0, 0.0, 0.0); }
vec3 floor_albedo(vec2 at, vec4 ground, Footprint fp) { return vec3(0.0); }

// Ground 9 m over still water, along rays from x to y.
// @part ground_over
vec2 shore_place(vec2 p) { return p; }
vec4 shore_floor(vec2 q) { return vec4(9.0, 0.0, 0.0, 0.0); }
vec2 land_span(vec2 q, float height, vec3 ray) { return ray.xy; }
vec3 march_start(vec3 ray) { return vec3(0.0); }
float march_tolerance() { return 1e-3; }
float land_free(vec2 q, float y, vec3 r, float aside, float raised, float from, float leave) { return from; }
void march_ground(vec2 q, float height, vec3 ray, float leave, float fine, float near, bool dry,
    inout float tau, out float before, out float gap, out vec4 ground) {
    before = tau;
    gap = -9.0;
    ground = shore_floor(q);
}
void refine_ground(vec2 q, float height, vec3 ray, float sense, float fine, float least,
    int rounds, bool crests, inout float tau, inout float gap, inout vec4 met) {}

// @part no_sky
vec3 mirrored_sky(vec3 r, vec3 spread) { return vec3(0.0); }
float mirror_guess(vec3 place, vec3 r) { return -1.0; }

// @part counted_texels
float outside = 0.0;
vec4 cube_texel(int face, ivec2 at) {
    outside += all(greaterThanEqual(at, ivec2(0))) && all(lessThan(at, ivec2(CUBE_SIZE))) ? 0.0 : 1.0;
    return vec4(0.0);
}

// @part smooth_texels
vec4 cube_texel(int face, ivec2 at) {
    vec2 side = 2.0 * vec2(at) / float(CUBE_SIZE - 1) - 1.0;
    vec3 d = normalize(cube_direction(face, side));
    return vec4(d.x * d.y, d.z, sin(3.0 * d.x + d.z), 0.0);
}

// A ledge of a slope before a chasm.
// @part ledge
float slope;
vec4 field_at(vec2 p) { return vec4(p.x < 1.2 ? 1.0 : -10.0, slope, 0.0, 0.0); }

// @part no_short_waves
uniform float u_surface_grain;
const bool SHORT_WAVES = false;
vec3 short_waves() { return vec3(0.0); }

// @part still_water
uniform float u_eye_height;
uniform float u_surface_trough;
float march_tolerance() { return 1e-4; }
vec3 march_start(vec3 ray) { return vec3(0.0); }
vec3 surface_now() { return vec3(0.0); }
float surface_gentler(vec3 ray, float from) { return 0.0; }
vec3 surface_beyond(vec3 ray, float from) { return vec3(0.0); }
void march_open(vec3 ray, float leave, float fine, vec3 now, vec2 less, float bend, inout float tau) {}
float march_ahead(vec3 ray, float tau, float gap, float rate, float fine, vec3 now, vec2 less, float bend) {
    return 1.0;
}
vec3 waves(vec2 p) { return vec3(0.0); }
void refine_water(vec2 q, float height, vec3 ray, float sense, float fine, float least, int rounds, bool crests,
    inout float tau, inout float gap, inout vec3 wave) {}

// @part water_of_a_slope
uniform float u_eye_height;
float slope;
Footprint footprint(vec3 ray, float tau, vec3 normal) { return Footprint(vec2(0.0), vec2(0.0)); }
vec4 waves_shading(vec2 p, Footprint fp) { return vec4(0.0, slope, 0.0, 0.0); }
