// A sample of a boat where it stands before water and land: BOAT_SIDE x BOAT_SIDE rays through it. Linear light, premultiplied.
out vec4 o_color;

const int BOAT_RAYS = BOAT_SIDE * BOAT_SIDE;

vec3 boat_ray(int i) {
    return camera_ray(sample_place() + (vec2(i % BOAT_SIDE, i / BOAT_SIDE) + 0.5) / float(BOAT_SIDE) - 0.5);
}

// Where no ray can meet a boat, and then where none does, nothing more is asked: a discarded sample is the one branch that every driver takes.
void main() {
    if (!near_boats(camera_ray(sample_place()), length(u_ray_x) / u_viewport.x + length(u_ray_y) / u_viewport.y)) {
        discard;
    }
    vec3 eye = vec3(0.0, u_eye_height, 0.0);
    int boat[BOAT_RAYS];
    float way[BOAT_RAYS];
    BoatHit hits[BOAT_RAYS];
    bool met = false;
    float farthest = 0.0;
    for (int i = 0; i < BOAT_RAYS; ++i) {
        boat[i] = trace_boats(eye, normalize(boat_ray(i)), 0.0, 1e5, false, way[i], hits[i]);
        met = met || boat[i] >= 0;
        farthest = boat[i] >= 0 ? max(farthest, way[i]) : farthest;
    }
    if (!met) {
        discard;
    }
    vec3 middle = camera_ray(sample_place());
    // A little further: the samples' other rays may meet the water before.
    boat_water(middle, 1.02 * farthest / length(middle));
    vec4 sum = vec4(0.0);
    for (int i = 0; i < BOAT_RAYS; ++i) {
        vec3 ray = boat_ray(i);
        vec3 d = normalize(ray);
        if (boat[i] >= 0 && !boat_hidden(ray, way[i])) {
            vec3 light = exposure() * boat_before(boat_light(boat[i], eye, d, way[i], hits[i]), d, way[i]);
            sum += vec4(min(light, BRIGHTEST), 1.0);
        }
    }
    if (sum.a == 0.0) {
        discard;
    }
    o_color = sum / float(BOAT_RAYS);
}
