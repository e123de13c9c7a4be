// Whether a drop is under the water or behind it. drop: from the eye, m; depth: of it along the view.
bool spray_hidden(vec3 drop, float depth) {
    // Nor does an eye under the surface see any.
    if (u_eye_height < waves(vec2(0.0)).x) {
        return true;
    }
    if (drop.y + u_eye_height < waves(drop.xz).x) {
        return true;
    }
    float tau;
    vec3 wave;
    return find_surface(drop / depth, 0.999 * depth, tau, wave);
}
