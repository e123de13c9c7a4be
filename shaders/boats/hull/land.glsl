// Whether land stands before a boat.
bool boat_behind_land(vec3 ray, float farthest) {
    float tau;
    vec4 ground;
    return find_land(ray, farthest, tau, ground);
}
