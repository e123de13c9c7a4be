// Whether a drop is under water or ground, or behind them. drop: from the eye, m; depth: of it along the view.
bool spray_hidden(vec3 drop, float depth) {
    // Nor does an eye under the surface see any.
    if (u_eye_height < waves(vec2(0.0)).x) {
        return true;
    }
    float height = drop.y + u_eye_height;
    if (height < waves(drop.xz).x || height < shore_floor(shore_place(drop.xz)).x) {
        return true;
    }
    float tau;
    vec3 wave;
    if (find_surface(drop / depth, 0.999 * depth, tau, wave)) {
        return true;
    }
    vec4 ground;
    return find_land(drop / depth, 0.999 * depth, tau, ground);
}
