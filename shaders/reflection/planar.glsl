// Water mirrors what the planar mirror holds, and the sky. The reflected ray is followed to the place that it meets: the map's
// own distances tell how far that is, and its place in the map is the mirrored place's. Exact on still water to the map's texels.
// r: reflected direction, over the horizon, a unit vector.
// Land is looked for at MIRROR_LOOKS places, up to MIRROR_FAR metres away.
uniform sampler2D u_mirror;

// Light that the map holds toward a place in clip space, and its coverage; way: from the mirrored eye, m, where there is any.
vec4 mirror_read(vec2 clip, inout float way) {
    vec2 at = (clip / MIRROR_MARGIN * 0.5 + 0.5) * float(MIRROR_SIZE) - 0.5;
    vec2 base = floor(at);
    vec2 t = at - base;
    vec4 sum = vec4(0.0);
    float near = 0.0;
    for (int i = 0; i < 4; ++i) {
        ivec2 corner = ivec2(base) + ivec2(i & 1, i >> 1);
        vec2 w = mix(1.0 - t, t, vec2(corner - ivec2(base)));
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
    // Land may be anywhere: the first point along the ray that has some before it.
    for (int i = 0; i < MIRROR_LOOKS && way < 0.0; ++i) {
        float far = MIRROR_FAR * exp2(float(i + 1 - MIRROR_LOOKS));
        vec4 there = mirror_toward(place + far * r, seen, mirrored);
        way = there.a > 0.0 && mirrored < 1.01 * length(seen) ? far : way;
    }
    if (way < 0.0) {
        return sky;
    }
    vec4 found = vec4(0.0);
    for (int i = 0; i < MIRROR_STEPS; ++i) {
        found = mirror_toward(place + way * r, seen, mirrored);
        // What the map saw there, and how far along r that is.
        vec3 hit = normalize(seen) * mirrored;
        way = max(dot(vec3(hit.x, -hit.y - u_eye_height, hit.z) - place, r), 0.01);
    }
    return found.rgb + (1.0 - found.a) * sky;
}
