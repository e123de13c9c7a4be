// The ground where a ray meets it: linear light, A = foam amount. d: unit vector along the ray.
vec4 land_color(vec3 ray, vec3 d, float tau, vec4 ground) {
    vec3 normal = normalize(vec3(-ground.y, 1.0, -ground.z));
    vec2 p = tau * ray.xz;
    Footprint fp = footprint(ray, tau, normal);
    vec2 q = shore_place(p);
    Soil soil = land_soil(q, ground, fp, land_wet(q, ground.x));
    float sun = shade_sun(vec3(p.x, u_eye_height + tau * ray.y, p.y), fp);
    vec3 light = exposure() * land_light(d, normal, soil, sun);
    float amount = land_foam(p, ground.x, fp);
    if (amount > 0.0) {
        light = mix(light, exposure() * foam_light(normal), amount);
    }
    return vec4(min(in_air(light, d, tau * length(ray)), BRIGHTEST), amount);
}
