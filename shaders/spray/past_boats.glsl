// Whether water, land or a boat is before a drop. depth: of it along the view, m.
bool spray_hidden(vec3 drop, float depth) {
    vec3 eye = vec3(0.0, u_eye_height, 0.0);
    float away = length(drop);
    float t;
    BoatHit hit;
    return trace_boats(eye, drop / away, 0.0, 0.999 * away, false, t, hit) >= 0 || spray_hidden_openly(drop, depth);
}
