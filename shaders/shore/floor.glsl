// The floor of shallow water and light through it.

// @part body
// Water over the shore's floor: what comes back from it is absorbed and scattered out along the true way down and up.
float shore_path = 0.0;          // m; set before the water is shaded
vec3 shore_albedo = vec3(0.0);

vec3 water_body(vec3 below, vec3 deep, vec3 extinction, float cv, float height) {
    return mix(deep, shore_albedo * below, exp(-extinction * shore_path));
}

// @part floor
// Height of floor or land over y = 0 (m) and its gradient. w: tint in [0, 1]. q: metres from the middle of the square.
uniform sampler2D u_shore_floor; // height (m), tint

vec4 shore_floor(vec2 q) {
    SplineTaps taps = spline_taps(q, FLOOR_TEXELS);
    vec4 sum = vec4(0.0);
    for (int j = 0; j < 3; ++j) {
        for (int i = 0; i < 3; ++i) {
            vec2 here = spline_texel(u_shore_floor, FLOOR_TEXELS, taps, i, j).rg;
            // Not by products of weights: shared with those of the map at the same place they would be kept in registers.
            sum += vec4(
                here.x * taps.wx[i] * taps.wz[j], here.x * taps.sx[i] * taps.wz[j], here.x * taps.wx[i] * taps.sz[j],
                here.y * taps.wx[i] * taps.wz[j]);
        }
    }
    sum.yz *= taps.scale;
    return sum;
}

// @part floor_normal
// Normal of land and floor, up. p: m from the eye.
vec3 floor_normal(vec2 p) {
    vec4 ground = shore_floor(shore_place(p));
    return normalize(vec3(-ground.y, 1.0, -ground.z));
}

// @part through
// The shore's floor where the ray refracted at the surface meets it. docs/formulae.md, section 8.

// Way of the refracted ray from the surface to the floor and of the light straight down to it, m; `at`: where it meets the
// floor. d, n: unit vectors. Steps of the fixed point that starts from the depth right under.
float floor_path(vec2 q, float height, vec3 d, vec3 n, out vec2 at) {
    vec3 r = refracted(d, n, -dot(n, d), INDEX);
    float fall = max(-r.y, 0.25);
    at = q;
    float under = max(height - shore_floor(q).x, 0.0);
    for (int i = 0; i < REFRACTION_STEPS; ++i) {
        at = q + r.xz * (under / fall);
        under = max(height - shore_floor(at).x, 0.0);
    }
    return under * (1.0 + 1.0 / fall);
}

void look_through(vec2 p, float height, vec3 d, vec3 normal, float unresolved, Footprint fp) {
    vec2 at;
    shore_path = floor_path(shore_place(p), height, d, normal, at);
    shore_albedo = floor_albedo(at, shore_floor(at), fp);
}

// @part shallow
// The floor under shallow water is the land in detail, soaked, or the water's edge would show as a seam; deeper it is the plain ground.
vec3 floor_albedo(vec2 at, vec4 ground, Footprint fp) {
    float deep = smoothstep(0.1, 0.6, -ground.x);
    // Seen as if it lay far lower: plants of the land do not grow there.
    vec4 sunk = vec4(ground.x - 8.0 * smoothstep(0.0, 0.15, -ground.x), ground.yzw);
    vec3 soaked = deep < 1.0 ? land_soil(at, sunk, fp, vec2(1.0)).albedo : vec3(0.0);
    return mix(soaked, ground_albedo(ground, shore_grain(at, fp)), deep);
}

// @part shallow_plain
// The floor under water is the plain ground.
vec3 floor_albedo(vec2 at, vec4 ground, Footprint fp) {
    return ground_albedo(ground, shore_grain(at, fp));
}

// @part soil_found
// What a sample of land is. amount: of foam on it.
Soil land_sample(vec2 p, vec4 ground, Footprint fp, out float amount) {
    vec2 q = shore_place(p);
    amount = land_foam(p, ground.x, fp);
    return land_soil(q, ground, fp, land_wet(q, ground.x));
}

// @part soil_kept
// The same, found by an earlier pass.
uniform sampler2DArray u_surface_samples;

Soil land_sample(vec2 p, vec4 ground, Footprint fp, out float amount) {
    ivec2 at = as_int(floor(gl_FragCoord.xy));
    vec4 color = texel_at(u_surface_samples, ivec3(at, 0));
    vec4 relief = texel_at(u_surface_samples, ivec3(at, 1));
    amount = relief.w;
    return Soil(relief.xyz, color.rgb, color.a);
}

// @part color
// The ground where a ray meets it: linear light, A = foam amount. d: unit vector along the ray.
vec4 land_color(vec3 ray, vec3 d, float tau, vec4 ground) {
    vec3 normal = normalize(vec3(-ground.y, 1.0, -ground.z));
    vec2 p = tau * ray.xz;
    Footprint fp = footprint(ray, tau, normal);
    float amount;
    Soil soil = land_sample(p, ground, fp, amount);
    float sun = shade_sun(vec3(p.x, u_eye_height + tau * ray.y, p.y), fp);
    vec3 light = exposure() * land_light(d, normal, soil, sun);
    if (amount > 0.0) {
        light = mix(light, exposure() * foam_light(normal), amount);
    }
    return vec4(min(in_air(light, d, tau * length(ray)), BRIGHTEST), amount);
}
