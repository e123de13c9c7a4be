// Height of a drop over the water, m. drop: from the eye, m.
float spray_over(vec3 drop) {
    return drop.y + u_eye_height - waves(drop.xz).x;
}

// Whether water is before a drop. depth: of it along the view, m.
bool spray_hidden(vec3 drop, float depth) {
    float tau;
    vec3 wave;
    return find_surface(drop / depth, 0.999 * depth, tau, wave);
}
