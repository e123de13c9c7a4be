// Single waves of an earlier time that travel in groups: even_fronts is that of waves of one height.
uniform vec2 u_wave_groups_velocity; // m/s

// Height, gradient and rise (m/s) of the waves at a place, age seconds ago.
vec4 fronts_then(vec2 p, float age) {
    vec4 even = even_fronts(p, age);
    vec3 group = wave_groups(p + u_wave_groups_velocity * age);
    return vec4(group.x * even.x, group.x * even.yzw + even.x * vec3(group.yz, -dot(u_wave_groups_velocity, group.yz)));
}
