// What stands before a boat: water, or land. Water is looked for once a sample: as far as a sample is wide it is as good as a plane,
// where the sample's own ray meets it.
vec4 boat_plane = vec4(0.0); // normal . place is w, metres from the eye; no normal: no water before the boats

void boat_water(vec3 ray, float farthest) {
    float tau;
    vec3 wave;
    if (find_surface(ray, farthest, tau, wave)) {
        vec3 normal = vec3(-wave.y, 1.0, -wave.z);
        boat_plane = vec4(normal, dot(normal, tau * ray));
    }
}

bool boat_hidden(vec3 ray, float t) {
    float tau = t / length(ray);
    // On the far side of the plane from the eye; an eye on that side itself is under water, and sees none.
    bool under = boat_plane.y > 0.0 && (boat_plane.w >= 0.0 || tau * dot(boat_plane.xyz, ray) < boat_plane.w);
    return under || boat_behind_land(ray, tau);
}

vec3 boat_before(vec3 light, vec3 d, float t) {
    return boat_in_air(light, d, t);
}
