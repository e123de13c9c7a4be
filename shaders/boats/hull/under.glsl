// An eye under the surface sees what of a boat is under it too, through the water between.
void boat_water(vec3 ray, float farthest) {
}

bool boat_hidden(vec3 ray, float t) {
    float tau;
    vec3 wave;
    return (find_underside(ray, tau, wave) && tau * length(ray) < t) || bed_reach(vec2(0.0), u_eye_height, normalize(ray)) < t;
}

vec3 boat_before(vec3 light, vec3 d, float t) {
    return light * exp(-below_extinction() * t) + below_glow(-u_eye_height, -d.y, t);
}
