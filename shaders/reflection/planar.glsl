// Water mirrors what the planar mirror holds, and the sky. The reflected ray is followed to the place that it meets: the map's
// own distances tell how far that is, and its place in the map is the mirrored place's. Exact on still water to the map's texels.
// r: reflected direction, over the horizon; d: from the eye; n: normal; unit vectors.
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
        vec4 texel = inside ? texelFetch(u_mirror, corner, 0) : vec4(0.0);
        float share = w.x * w.y * (texel.a > 0.0 ? 1.0 : 0.0);
        sum += share * vec4(texel.rgb, 1.0);
        near = max(near, texel.a);
    }
    way = near > 0.0 ? 1.0 / near : way;
    return sum;
}

vec3 reflected_light(vec3 r, vec3 d, vec3 n) {
    vec3 sky = sky_light(r);
    vec3 place = mirror_place(d);
    // Columns of the inverse of the camera's rays, up to their lengths: right, up and forward are at right angles.
    vec3 across = u_ray_x / dot(u_ray_x, u_ray_x);
    vec3 upward = u_ray_y / dot(u_ray_y, u_ray_y);
    float way = mirror_guess(place, r, u_mirror_level);
    if (way < 0.0) {
        return sky;
    }
    vec4 found = vec4(0.0);
    for (int i = 0; i < MIRROR_STEPS; ++i) {
        // Mirrored, the place that the ray meets lies under still water, and we look at it through that.
        vec3 met = place + way * r;
        vec3 seen = vec3(met.x, 2.0 * u_mirror_level - met.y - u_eye_height, met.z);
        float depth = dot(seen, u_ray_z);
        if (depth < 1e-3) {
            return sky;
        }
        float mirrored = length(seen);
        found = mirror_read(vec2(dot(seen, across), dot(seen, upward)) / depth, mirrored);
        // What the map saw there, and how far along r that is.
        vec3 hit = normalize(seen) * mirrored;
        way = max(dot(vec3(hit.x, 2.0 * u_mirror_level - hit.y, hit.z) - vec3(0.0, u_eye_height, 0.0) - place, r), 0.01);
    }
    return found.rgb + (1.0 - found.a) * sky;
}
