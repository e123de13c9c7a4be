// Parametric waves that travel in groups: even_waves and even_shading are those of one height, about still water.

// Height and its gradient.
vec3 parametric_waves(vec2 p) {
    vec3 even = even_waves(p);
    vec3 group = wave_groups(p);
    return vec3(group.x * even.x, group.x * even.yz + even.x * group.yz);
}

// Height and gradient without what is smaller than the footprint, and the unresolved mean square slope; groups that are smaller are
// replaced by their mean.
vec4 parametric_shading(vec2 p, Footprint fp) {
    vec4 even = even_shading(p, fp);
    vec3 group = wave_groups(p);
    parametric_signal *= group.x;
    parametric_signal_x *= group.x;
    parametric_signal_z *= group.x;
    parametric_carried *= group.x;
    float square = group.x * group.x;
    if (SURFACE_FILTER) {
        float width = sqrt(max(dot(fp.x, fp.x), dot(fp.y, fp.y)) * dot(u_wave_groups.xy, u_wave_groups.xy));
        float kept = 1.0 - smoothstep(0.5, 2.0, width);
        float mean = 1.0 - 0.5 * u_wave_groups.z;
        group = vec3(mean + kept * (group.x - mean), kept * group.yz);
        square = mix(mean * mean + GROUP_VARIANCE * u_wave_groups.z * u_wave_groups.z, square, kept);
    }
    return vec4(group.x * even.x, group.x * even.yz + even.x * group.yz, square * even.w);
}
