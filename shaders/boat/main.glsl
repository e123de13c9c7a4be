// A sample of a boat where it stands before water and land: BOAT_SIDE x BOAT_SIDE rays through it. Linear light, premultiplied.
out vec4 o_color;

// Light of a boat on this ray and 1, or nothing.
vec4 boat_seen(vec3 ray) {
    float size = length(ray);
    vec3 eye = vec3(0.0, u_eye_height, 0.0);
    vec3 d = ray / size;
    float t;
    BoatHit hit;
    int i = trace_boats(eye, d, 0.0, 1e5, false, t, hit);
    if (i < 0) {
        return vec4(0.0);
    }
    if (boat_hidden(ray, t)) {
        return vec4(0.0);
    }
    return vec4(min(exposure() * boat_before(boat_light(i, eye, d, t, hit), d, t), BRIGHTEST), 1.0);
}

void main() {
    if (!near_boats(camera_ray(gl_FragCoord.xy), length(u_ray_x) / u_viewport.x + length(u_ray_y) / u_viewport.y)) {
        discard;
    }
    vec4 sum = vec4(0.0);
    for (int i = 0; i < BOAT_SIDE * BOAT_SIDE; ++i) {
        vec2 offset = (vec2(i % BOAT_SIDE, i / BOAT_SIDE) + 0.5) / float(BOAT_SIDE) - 0.5;
        sum += boat_seen(camera_ray(sample_place() + offset));
    }
    if (sum.a == 0.0) {
        discard;
    }
    o_color = sum / float(BOAT_SIDE * BOAT_SIDE);
}
