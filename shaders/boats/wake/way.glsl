// A place seen from a boat's course: how far behind its bow, along the circle, and how far to the side, outward.
struct WakeWay {
    float behind;    // m
    float aside;     // m
    vec2 on_behind;  // gradients along x and z
    vec2 on_aside;
};

WakeWay wake_way(int i, vec2 p) {
    vec4 course = u_boat_course[i];
    float radius = abs(course.w);
    float turn = course.w < 0.0 ? -1.0 : 1.0;
    vec2 from = p + course.xy;
    // At the centre there is no way round it; no wake reaches there.
    float far = max(length(from), 0.1 * radius);
    float angle = turn * (course.z - atan(from.y, from.x));
    // Three tenths of a radian lie before the boat, the rest of the circle behind it.
    angle = angle + 0.3 - TAU * floor((angle + 0.3) / TAU) - 0.3;
    return WakeWay(
        radius * angle + BOAT_STEM * u_boat_form[i].x, length(from) - radius,
        -turn * radius / (far * far) * vec2(-from.y, from.x), from / far);
}
