// What stands before a boat t metres away: water, or land.
bool boat_hidden(vec3 ray, float t) {
    float tau;
    vec3 wave;
    return find_surface(ray, t / length(ray), tau, wave) || boat_behind_land(ray, t / length(ray));
}

vec3 boat_before(vec3 light, vec3 d, float t) {
    return boat_in_air(light, d, t);
}
