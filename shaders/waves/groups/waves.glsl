// Parametric waves that travel in groups: even_waves and even_shading are those of one height, about still water.

// Height and its gradient.
vec3 parametric_waves(vec2 p) {
    vec3 group = wave_groups(p);
    vec3 even = even_waves(p);
    return vec3(group.x * even.x, group.x * even.yz + even.x * group.yz);
}

// Height and gradient without what is smaller than the footprint, and the unresolved mean square slope.
vec4 parametric_shading(vec2 p, Footprint fp) {
    vec3 group = wave_groups(p);
    vec4 even = even_shading(p, fp);
    parametric_signal *= group.x;
    parametric_signal_x *= group.x;
    parametric_signal_z *= group.x;
    parametric_carried *= group.x;
    return vec4(group.x * even.x, group.x * even.yz + even.x * group.yz, group.x * group.x * even.w);
}
