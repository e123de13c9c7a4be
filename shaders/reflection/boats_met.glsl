// The boat that a ray meets from o along d (unit), m away, and its light; negative: none. far: as a mirror's map sees it.
float boats_met(vec3 o, vec3 d, bool far, out vec3 light) {
    float t;
    BoatHit hit;
    int i = trace_boats(o, d, 0.0, 1e5, far, t, hit);
    light = vec3(0.0);
    if (i < 0) {
        return -1.0;
    }
    light = boat_in_air(boat_light(i, o, d, t, hit), d, t);
    return t;
}
