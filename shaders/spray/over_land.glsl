// Height of a drop over water and ground, m. drop: from the eye, m.
float spray_over(vec3 drop) {
    return drop.y + u_eye_height - max(waves(drop.xz).x, shore_floor(shore_place(drop.xz)).x);
}

// Whether water or land is before a drop. depth: of it along the view, m.
bool spray_hidden(vec3 drop, float depth) {
    float tau;
    vec3 wave;
    if (find_surface(drop / depth, 0.999 * depth, tau, wave)) {
        return true;
    }
    vec4 ground;
    return find_land(drop / depth, 0.999 * depth, tau, ground);
}
