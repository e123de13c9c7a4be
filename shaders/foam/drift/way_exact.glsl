// The ways back, gone at each sample, and how they change along x and z, a unit, over 2 cm: less is lost in float32's rounding.
vec4 drift_way(vec2 q) {
    vec2 first = drift_origin(q, 0);
    return vec4(first - q, drift_origin(first, 1) - q);
}

void drift_ways(vec2 q, out vec4 way, out vec4 along_x, out vec4 along_z) {
    way = drift_way(q);
    along_x = (drift_way(q + vec2(0.02, 0.0)) - way) / 0.02;
    along_z = (drift_way(q + vec2(0.0, 0.02)) - way) / 0.02;
}
