// What the water mirrors: sky, land and boats, traced or from what rising rays meet.

// @part open
// Nothing but the sky stands around. r: unit vector.
vec3 surroundings(vec3 r, vec3 spread) {
    return mirrored_sky(r, spread);
}

// @part sky
// Water mirrors the sky alone. r: reflected direction, over the horizon, a unit vector.
// place: where on the water, from under the eye, y over still water, m.
vec3 reflected_light(vec3 place, vec3 r, vec3 spread) {
    return mirrored_sky(r, spread);
}

// @part exact
// Water mirrors what stands around, found anew for each sample. r: reflected direction, a unit vector.
// place: where on the water, from under the eye, y over still water, m.
vec3 reflected_light(vec3 place, vec3 r, vec3 spread) {
    return surroundings(r, spread);
}

// @part guess
// How far along the reflected ray the boat may be that comes nearest to it, m; negative: none comes near.
float mirror_guess(vec3 place, vec3 r) {
    float best = 1.0;
    float way = -1.0;
    for (int i = 0; i < BOAT_COUNT; ++i) {
        float size = u_boat_form[i].x;
        vec2 at = boat_place(i);
        vec3 to = vec3(at.x, 0.35 * size, at.y) - place;
        float along = dot(to, r);
        float miss = (dot(to, to) - along * along) / (size * size);
        // What a boat is, and how far it may tilt and rise, is within its length of there.
        if (along > -size && miss < best) {
            best = miss;
            way = max(along, 0.01);
        }
    }
    return way;
}

// @part land
// Land that a ray meets from anywhere over the water. docs/formulae.md, section 10.
const float AROUND_BLUR = 0.012; // ripples blur what is finer, rad

// First hit with land of a ray r (unit vector) from a place in the square (m from its middle) at a height.
bool land_along(vec2 q, float height, vec3 r, out float tau, out vec4 ground) {
    vec2 span = land_span(q, height, r);
    tau = span.x;
    ground = vec4(0.0);
    if (span.x >= span.y) {
        return false;
    }
    tau = land_free(q, height, r, 0.0, 0.0, tau, span.y);
    float fine = 0.02 * MARCH_TOLERANCE;
    float before;
    float gap;
    march_ground(q, height, r, span.y, fine, 0.1, true, tau, before, gap, ground);
    return tau < span.y && gap < fine * (0.1 + tau);
}

// Its light, before exposure, in the air. o: the place as metres from under the eye.
vec3 land_seen(vec2 q, vec2 o, vec3 r, float tau, vec4 ground) {
    vec3 normal = normalize(vec3(-ground.y, 1.0, -ground.z));
    Footprint fp = Footprint(vec2(AROUND_BLUR * tau, 0.0), vec2(0.0, AROUND_BLUR * tau));
    Soil soil = land_soil(q + tau * r.xz, ground, fp, vec2(1.0, 0.6) * shore_wet(ground.x));
    vec3 place = vec3(o + tau * r.xz, ground.x).xzy;
    return hazed(land_light(r, normal, soil, sunlit(place, fp)), horizon_light(r), tau);
}

// @part land_around
// Sky and land as seen from a metre over the water, or over the ground, right under the eye. docs/formulae.md, section 10.
const float AROUND_HEIGHT = 1.0; // m

vec3 surroundings(vec3 r, vec3 spread) {
    vec2 eye = shore_place(vec2(0.0));
    float height = AROUND_HEIGHT + max(shore_floor(eye).x, 0.0);
    float tau;
    vec4 ground;
    return land_along(eye, height, r, tau, ground) ? land_seen(eye, vec2(0.0), r, tau, ground) : mirrored_sky(r, spread);
}

// @part land_met
// The land that a ray meets from o along d (unit), m away, and its light; negative: none.
float land_met(vec3 o, vec3 d, out vec3 light) {
    vec2 q = shore_place(o.xz);
    float t;
    vec4 ground;
    light = vec3(0.0);
    if (!land_along(q, o.y, d, t, ground)) {
        return -1.0;
    }
    light = land_seen(q, o.xz, d, t, ground);
    return t;
}

// @part boats_met
// The boat that a ray meets from o along d (unit), m away, and its light; negative: none. far: as a mirror's map sees it.
float boats_met(vec3 o, vec3 d, bool far, out vec3 light) {
    float t;
    int met = meet_boat(o, d, far, NO_BOAT, t);
    vec3 place = o + t * d;
    light = vec3(0.0);
    if (met < 0) {
        return -1.0;
    }
    light = boat_in_air(boat_light(met, met_paint(met, place), place, d), d, t);
    return t;
}

// @part traced
// Water mirrors what stands over it by rays of its own, and the sky. Exact to float32. r: reflected direction, over the horizon, a unit
// vector.
// place: where on the water, from under the eye, y over still water, m.
vec3 reflected_light(vec3 place, vec3 r, vec3 spread) {
    vec3 light;
    return mirror_met(place, r, false, light) < 0.0 ? mirrored_sky(r, spread) : light;
}

// @part met
// What a ray meets over the water from o along d (unit), m away, and its light; negative: nothing but the sky.
float mirror_met(vec3 o, vec3 d, bool far, out vec3 light) {
    float boat = boats_met(o, d, far, light);
    vec3 other;
    float land = land_met(o, d, other);
    if (land >= 0.0 && (boat < 0.0 || land < boat)) {
        light = other;
        return land;
    }
    return boat;
}

// @part map_pass
// The planar mirror: what an eye as far under still water as ours is over it sees above it, in clip space MIRROR_MARGIN times
// as wide as the picture. RGB light before exposure, in the air; A = 1 / (way from the mirrored eye, m), 0 for sky.
out vec4 o_mirror;

void main() {
    vec2 clip = MIRROR_MARGIN * (2.0 * gl_FragCoord.xy / float(MIRROR_SIZE) - 1.0);
    vec3 ray = u_ray_z + clip.x * u_ray_x + clip.y * u_ray_y;
    vec3 d = normalize(vec3(ray.x, -ray.y, ray.z));
    vec3 eye = vec3(0.0, -u_eye_height, 0.0);
    o_mirror = vec4(0.0);
    // Clipped at still water: the mirrored ray begins where it comes out of it.
    float out_of_water = -eye.y / max(d.y, 1e-6);
    if (d.y < 1e-6 || out_of_water > 1e5) {
        return;
    }
    out_of_water = max(out_of_water, 0.0);
    vec3 o = eye + out_of_water * d;
    vec3 light;
    float t = mirror_met(o, d, true, light);
    if (t >= 0.0) {
        o_mirror = vec4(min(light, BRIGHTEST), 1.0 / max(out_of_water + t, 1e-3));
    }
}

// @part planar
// Water mirrors what the planar mirror holds, and the sky. The reflected ray is followed to the place that it meets: the map's
// own distances tell how far that is, and its place in the map is the mirrored place's. Exact on still water to the map's texels.
// r: reflected direction, over the horizon, a unit vector.
// Land is looked for at MIRROR_LOOKS places, up to MIRROR_FAR metres away.
uniform sampler2D u_mirror;

const float MIRROR_ASIDE = 0.45; // of two looks from their mean, over the deviation up and down of those that no sample resolves

// Light that the map holds toward a place in clip space, and its coverage; way: from the mirrored eye, m, where there is any.
vec4 mirror_read(vec2 clip, inout float way) {
    vec2 at = (clip / MIRROR_MARGIN * 0.5 + 0.5) * float(MIRROR_SIZE) - 0.5;
    vec2 base = floor(at);
    vec2 t = at - base;
    vec4 sum = vec4(0.0);
    float near = 0.0;
    for (int i = 0; i < 4; ++i) {
        ivec2 corner = as_int(base) + ivec2(i & 1, i >> 1);
        vec2 w = mix(1.0 - t, t, vec2(corner - as_int(base)));
        bool inside = all(greaterThanEqual(corner, ivec2(0))) && all(lessThan(corner, ivec2(MIRROR_SIZE)));
        vec4 texel = inside ? texel_at(u_mirror, corner) : vec4(0.0);
        float share = w.x * w.y * (texel.a > 0.0 ? 1.0 : 0.0);
        sum += share * vec4(texel.rgb, 1.0);
        near += share * texel.a;
    }
    // Mixed as the light is: it jumps neither where the four texels change nor where what they hold ends.
    way = near > 0.0 ? mix(way, sum.a / near, sum.a) : way;
    return sum;
}

// What the map holds toward a point over the water, which mirrored lies under it; way: as far as the point, then as what is there.
vec4 mirror_toward(vec3 point, out vec3 seen, inout float way) {
    seen = vec3(point.x, -point.y - u_eye_height, point.z);
    way = length(seen);
    float depth = dot(seen, u_ray_z);
    if (depth < 1e-3) {
        return vec4(0.0);
    }
    // Columns of the inverse of the camera's rays, up to their lengths: right, up and forward are at right angles.
    vec3 across = u_ray_x / dot(u_ray_x, u_ray_x);
    vec3 upward = u_ray_y / dot(u_ray_y, u_ray_y);
    return mirror_read(vec2(dot(seen, across), dot(seen, upward)) / depth, way);
}

// place: where on the water, from under the eye, y over still water, m.
vec3 reflected_light(vec3 place, vec3 r, vec3 spread) {
    vec3 sky = mirrored_sky(r, spread);
    vec3 seen;
    float mirrored;
    float way = mirror_guess(place, r);
    vec3 aside = MIRROR_ASIDE * min(spread.z, r.y) / max(length(r.xz), 1e-6) * (vec3(0.0, 1.0, 0.0) - r.y * r);
    vec4 found = vec4(0.0);
    // One loop, so that programs hold what reads the map once: looks from -MIRROR_LOOKS on, for land, which may be anywhere, then steps.
    for (int i = way < 0.0 ? -MIRROR_LOOKS : 0; i < MIRROR_STEPS + 2 && (i < 0 || way > 0.0); ++i) {
        float far = i < 0 ? MIRROR_FAR * exp2(float(i + 1)) : way;
        vec3 look = i < MIRROR_STEPS ? r : normalize(i > MIRROR_STEPS ? r - aside : r + aside);
        vec4 there = mirror_toward(place + far * look, seen, mirrored);
        if (i < 0) {
            // The first point along the ray that has some before it.
            bool before = there.a > 0.0 && mirrored < 1.01 * length(seen);
            way = before ? far : way;
            i = before ? -1 : i;
        } else if (i < MIRROR_STEPS) {
            // What the map saw there, and how far along r that is.
            vec3 hit = normalize(seen) * mirrored;
            way = max(dot(vec3(hit.x, -hit.y - u_eye_height, hit.z) - place, r), 0.01);
        } else {
            found += 0.5 * there;
        }
    }
    return found.rgb + (1.0 - found.a) * sky;
}
