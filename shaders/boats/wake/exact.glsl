// Wakes worked out at the place itself.
uniform vec4 u_wake[BOAT_COUNT]; // k (rad/m), height (m), length (m), shortest waves (rad/m)

vec4 wake_here(int i, vec2 at) {
    return wake_pattern(at, u_wake[i], u_boat_form[i].x, abs(u_boat_course[i].w));
}
