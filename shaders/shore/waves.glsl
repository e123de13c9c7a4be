// Waves at a coast: shoaling, refraction and the run-up.

// @part field
// What shore waves know of a place, and its gradients.
// r phase (periods), g height (m), b skew (0 to 1), a share of the open sea's waves. q: metres from the middle of the square.
uniform sampler2D u_shore_map;

struct ShoreField {
    vec4 here;
    vec4 along_x; // change a metre
    vec4 along_z;
};

ShoreField shore_field(vec2 q) {
    SplineTaps taps = spline_taps(q, MAP_TEXELS);
    ShoreField sum = ShoreField(vec4(0.0), vec4(0.0), vec4(0.0));
    for (int j = 0; j < 3; ++j) {
        for (int i = 0; i < 3; ++i) {
            vec4 value = spline_texel(u_shore_map, MAP_TEXELS, taps, i, j);
            sum.here += taps.wx[i] * taps.wz[j] * value;
            sum.along_x += taps.sx[i] * taps.wz[j] * value;
            sum.along_z += taps.wx[i] * taps.sz[j] * value;
        }
    }
    sum.along_x *= taps.scale.x;
    sum.along_z *= taps.scale.y;
    return sum;
}

// @part ahead
// Land over y = 0 that the ray meets, as if there were no water.
bool find_land_ahead(vec3 ray, out float land_tau, out vec4 ground) {
    return find_land(ray, FARTHEST / max(length(ray.xz), 1e-6 * length(ray)), land_tau, ground);
}

// @part line
// Foam that the swash leaves on the sand: foam/saturation/surf.glsl@swept. It lies still.
float land_foam(vec2 p, float ground, Footprint fp) {
    vec2 q = shore_place(p);
    Footprint point = Footprint(vec2(0.0), vec2(0.0));
    float left = surf_swept(shore_field(q), ground, surf_patches(q, point), fp);
    surf_carried = vec3(0.0);
    return left > 0.0 ? min(foam_amount(left, p, fp), 1.0) : 0.0;
}

// @part waves
// Shore waves over what the floor leaves of the open sea's: skewed trochoids (Outerra 2011) from a table of profiles, each
// periodic along the way to the shore. Heights in metres, in [0, 2a]; exact to the table's and the map's splines.
uniform sampler2D u_shore_profiles; // height in [0, 1], and that of the next row; rows: skew
uniform float u_shore_time[1];      // -t over the period, as a phase

// Where in its wave a place is, in periods: 0 on the crest, rising toward the shore.
float shore_turn(float phase) {
    return fract(u_shore_time[0] / TAU - phase);
}

// Profile, its change a period, and a row.
vec3 shore_profile(float turn, float skew) {
    float at = turn * float(PROFILE_NODES) - 0.5;
    float base = floor(at + 0.5);
    vec3 w = bspline_weights(at + 0.5 - base);
    vec3 s = bspline_slopes(at + 0.5 - base);
    float y = clamp(skew, 0.0, 1.0) * float(PROFILE_ROWS - 1);
    int row = min(as_int(floor(y)), PROFILE_ROWS - 2);
    vec2 value = vec2(0.0);
    vec2 slope = vec2(0.0);
    for (int i = 0; i < 3; ++i) {
        vec2 pair = texel_at(u_shore_profiles, ivec2((as_int(base) + i - 1) & (PROFILE_NODES - 1), row)).rg;
        value += w[i] * pair;
        slope += s[i] * pair;
    }
    float share = y - float(row);
    return vec3(mix(value.x, value.y, share), mix(slope.x, slope.y, share) * float(PROFILE_NODES), (value.y - value.x) * float(PROFILE_ROWS - 1));
}

vec3 shore_waves(ShoreField f, vec3 profile) {
    vec4 change = vec4(-f.here.g * profile.y, profile.x, f.here.g * profile.z, 0.0);
    return vec3(f.here.g * profile.x, dot(change, f.along_x), dot(change, f.along_z));
}

// Height and its gradient.
vec3 waves(vec2 p) {
    vec3 sea = open_waves(p);
    vec2 q = shore_place(p);
    // Beyond the square the sea is open.
    if (any(greaterThan(abs(q), vec2(0.5 * u_shore_size)))) {
        return sea;
    }
    ShoreField f = shore_field(q);
    vec3 sum = vec3(sea.x * f.here.a, sea.yz * f.here.a + sea.x * vec2(f.along_x.a, f.along_z.a));
    if (SURF && f.here.g > 0.0) {
        sum += shore_waves(f, shore_profile(shore_turn(f.here.r), f.here.b));
    }
    return sum;
}

// How far the water where the waves turn by `turn` (periods) has been carried from where it rests: to and fro along the gradient of the
// waves' phase, m.
vec2 shore_carried(ShoreField f, float turn) {
    vec2 out_to_sea = vec2(f.along_x.r, f.along_z.r);
    return 1.5 * f.here.g * sin(TAU * turn) / max(length(out_to_sea), 1e-6) * out_to_sea;
}

vec2 shore_tilt; // gradient of the surface where it was shaded last

// The same without what is smaller than the footprint, and the unresolved mean square slope.
vec4 waves_shading(vec2 p, Footprint fp) {
    vec4 sea = open_shading(p, fp);
    vec2 q = shore_place(p);
    if (any(greaterThan(abs(q), vec2(0.5 * u_shore_size)))) {
        shore_tilt = sea.yz;
        return sea;
    }
    ShoreField f = shore_field(q);
    vec4 sum = vec4(sea.x * f.here.a, sea.yz * f.here.a + sea.x * vec2(f.along_x.a, f.along_z.a), sea.w * f.here.a * f.here.a);
    if (SURF && f.here.g > 0.0) {
        vec3 profile = shore_profile(shore_turn(f.here.r), f.here.b);
        vec2 change = vec2(f.along_x.r, f.along_z.r);
        float kept = 1.0;
        if (SURFACE_FILTER) {
            kept = wave_kept(TAU * change, fp);
        }
        float k = TAU * f.here.g * length(change);
        sum += vec4(shore_waves(f, vec3(mix(0.42, profile.x, kept), kept * profile.yz)), (1.0 - kept * kept) * 0.15 * k * k);
    }
    shore_tilt = sum.yz;
    return sum;
}

// @part still
// Without surf: what the floor leaves of the open sea's waves. In a texel the map's spline is a polynomial, of 3 reads in place of 9.
uniform sampler2D u_shore_share; // three texels side by side: what stands by 1, z and z^2; by 1, x and x^2

// Share, and its change a metre. q: metres from the middle of the square, in it.
vec3 shore_share(vec2 q) {
    vec2 place = (q / u_shore_size + 0.5) * float(MAP_TEXELS);
    vec2 base = min(floor(place), float(MAP_TEXELS - 1));
    vec2 t = place - base;
    ivec2 at = ivec2(3 * as_int(base.x), as_int(base.y));
    vec3 even = texel_at(u_shore_share, at).xyz;
    vec3 rising = texel_at(u_shore_share, at + ivec2(1, 0)).xyz;
    vec3 bent = texel_at(u_shore_share, at + ivec2(2, 0)).xyz;
    vec3 here = even + t.y * (rising + t.y * bent);
    vec3 change = rising + 2.0 * t.y * bent;
    vec2 slopes = vec2(here.y + 2.0 * t.x * here.z, change.x + t.x * (change.y + t.x * change.z));
    return vec3(here.x + t.x * (here.y + t.x * here.z), float(MAP_TEXELS) / u_shore_size * slopes);
}

// Height and its gradient.
vec3 waves(vec2 p) {
    vec3 sea = open_waves(p);
    vec2 q = shore_place(p);
    // Beyond the square the sea is open.
    if (any(greaterThan(abs(q), vec2(0.5 * u_shore_size)))) {
        return sea;
    }
    vec3 share = shore_share(q);
    return vec3(sea.x * share.x, sea.yz * share.x + sea.x * share.yz);
}

// The same without what is smaller than the footprint, and the unresolved mean square slope.
vec4 waves_shading(vec2 p, Footprint fp) {
    vec4 sea = open_shading(p, fp);
    vec2 q = shore_place(p);
    if (any(greaterThan(abs(q), vec2(0.5 * u_shore_size)))) {
        return sea;
    }
    vec3 share = shore_share(q);
    return vec4(sea.x * share.x, sea.yz * share.x + sea.x * share.yz, sea.w * share.x * share.x);
}
