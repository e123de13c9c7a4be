// The limits that are tried next: the least, and the ratio of each to the one before.
uniform sampler2D u_limits;
const bool LIMITS_FIRST = false;

vec2 limits() {
    return texelFetch(u_limits, ivec2(0), 0).xy;
}
