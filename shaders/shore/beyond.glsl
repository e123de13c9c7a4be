// Beyond the square of the shore the sea is open, and less steep.
uniform vec2 u_shore_bounds; // slope and second derivative (1/m) that the shore adds

// tau from which on no ray up to `aside` metres a unit beside this one is in the square; and what the bounds are less by from there.
vec3 surface_beyond(vec3 ray, float aside) {
    return vec3(shore_leaves(shore_place(vec2(0.0)), ray.xz, aside), u_shore_bounds);
}
