// The sum of a front's own waves, which travel in groups: even_signal is that of waves of one height.
vec2 front_signal(vec2 p, out vec2 by_x, out vec2 by_z) {
    float group = wave_groups(p).x;
    vec2 signal = group * even_signal(p, by_x, by_z);
    by_x *= group;
    by_z *= group;
    return signal;
}
