// Way to the level floor along d (unit) from a place at height y, m; 0 under the floor.
float bed_reach(vec2 p, float y, vec3 d) {
    return min(max(u_floor_depth + y, 0.0) / max(-d.y, 1e-6), 1e6);
}
