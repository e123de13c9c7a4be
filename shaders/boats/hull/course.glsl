// Where boats are: each runs round a circle. Metres from the eye; exact to float32, whatever the time and the place.
// docs/formulae.md, section 15.
uniform vec4 u_boat_course[BOAT_COUNT]; // from the centre to the eye x, z (m), bearing (rad), radius (m; negative: to port)
uniform vec4 u_boat_form[BOAT_COUNT];   // length (m), smoothing (m), cosine and sine of heel

vec2 boat_place(int i) {
    vec4 course = u_boat_course[i];
    return abs(course.w) * vec2(cos(course.z), sin(course.z)) - course.xy;
}

vec2 boat_forward(int i) {
    vec4 course = u_boat_course[i];
    return (course.w < 0.0 ? -1.0 : 1.0) * vec2(-sin(course.z), cos(course.z));
}
