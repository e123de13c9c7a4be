// Where a boat is and how it lies in the waves.

// @part course
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

// @part afloat
// What carries a boat: the drawn surface.
float boat_support(vec2 p, float draught) {
    return waves(p).x;
}

// @part aground
// What carries a boat: the drawn surface, or where that is too shallow the ground under its keel.
float boat_support(vec2 p, float draught) {
    return max(waves(p).x, shore_floor(shore_place(p)).x + draught);
}

// @part pass
// How each boat floats, a texel a boat: height of the water line amidships (m), the slope of its plane along x and z, and the boat's
// axes ahead and up; w of the first two: its place. The plane goes through the drawn surface at three hull points, each the mean over a
// disc (Radon's seven points).
layout(location = 0) out vec4 o_pose;
layout(location = 1) out vec4 o_ahead;
layout(location = 2) out vec4 o_up;

float boat_reading(vec2 p, float reach, float draught) {
    float sum = boat_support(p, draught);
    if (BOAT_READINGS == 1) {
        return sum;
    }
    sum *= 0.25;
    for (int i = 0; i < 6; ++i) {
        float turn = TAU * float(i) / 6.0;
        sum += 0.125 * boat_support(p + 0.816496580927726 * reach * vec2(cos(turn), sin(turn)), draught);
    }
    return sum;
}

void main() {
    int i = as_int(floor(gl_FragCoord.x));
    float size = u_boat_form[i].x;
    float reach = u_boat_form[i].y;
    float draught = BOAT_DRAUGHT * size;
    vec2 place = boat_place(i);
    vec2 ahead = boat_forward(i);
    vec2 right = vec2(-ahead.y, ahead.x);
    float bow = boat_reading(place + BOAT_BOW * size * ahead, reach, draught);
    vec2 quarter = place - BOAT_QUARTER * size * ahead;
    float port = boat_reading(quarter - BOAT_BEAM * size * right, reach, draught);
    float starboard = boat_reading(quarter + BOAT_BEAM * size * right, reach, draught);
    float along = (bow - 0.5 * (port + starboard)) / ((BOAT_BOW + BOAT_QUARTER) * size);
    float across = (starboard - port) / (2.0 * BOAT_BEAM * size);
    vec2 slope = along * ahead + across * right;
    // A breaking crest or a step of the ground may stand steeper under the hull: no boat tilts over 45 degrees.
    slope /= max(length(slope), 1.0);
    o_pose = vec4(0.5 * (port + starboard) + along * BOAT_QUARTER * size, slope, place.x);
    vec3 upright = normalize(vec3(-slope.x, 1.0, -slope.y));
    vec3 level = vec3(ahead.x, 0.0, ahead.y);
    level = normalize(level - dot(level, upright) * upright);
    vec2 heel = u_boat_form[i].zw;
    o_ahead = vec4(level, place.y);
    o_up = vec4(heel.x * upright + heel.y * cross(level, upright), 0.0);
}
