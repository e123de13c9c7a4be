// How much of a group of waves foams: by the length of their sum, 1 where all crests meet.
uniform vec2 u_front_group; // share of the greatest sum where foam starts, and where it is full

float front_gate(float rho) {
    return FRONT_GATED ? smoothstep(u_front_group.x, u_front_group.y, rho) : 1.0;
}
