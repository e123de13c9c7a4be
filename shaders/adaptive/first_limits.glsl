// The limits that are tried at first: the least, and the ratio of each to the one before.
const bool LIMITS_FIRST = true;

vec2 limits() {
    return vec2(CHOOSE_LEAST, CHOOSE_STEP);
}
