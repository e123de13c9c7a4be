// Beyond the square of the shore the sea is open, and less steep.
uniform vec2 u_shore_bounds; // slope and second derivative (1/m) that the shore adds

// tau from which on no ray up to `aside` metres a unit beside this one is in the square; and what the bounds are less by from there.
vec3 surface_beyond(vec3 ray, float aside) {
    vec2 left = max(0.5 * u_shore_size - sign(ray.xz) * shore_place(vec2(0.0)), 0.0);
    vec2 outward = abs(ray.xz) - aside;
    vec2 leaves = mix(vec2(1e30), left / max(outward, 1e-9), greaterThan(outward, vec2(1e-9)));
    return vec3(min(leaves.x, leaves.y), u_shore_bounds);
}
