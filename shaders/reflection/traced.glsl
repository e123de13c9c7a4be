// Water mirrors boats by rays of its own, and the sky. r: reflected direction, over the horizon; d: from the eye; n: normal;
// unit vectors. Exact to float32.
vec3 reflected_light(vec3 r, vec3 d, vec3 n) {
    vec3 place = mirror_place(d);
    float t;
    BoatHit hit;
    int i = trace_boats(place, r, 0.0, 1e5, false, t, hit);
    return i < 0 ? sky_light(r) : boat_in_air(boat_light(i, place, r, t, hit), r, t);
}
