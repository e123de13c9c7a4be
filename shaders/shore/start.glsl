// How far the rays between ray - side - top and ray + side + top are free of land over y = 0.
vec3 land_start(vec3 ray, vec3 side, vec3 top) {
    Pyramid rays = pyramid(ray, side, top);
    float enter = max(pyramid_enters(rays, u_eye_height - u_shore_top, rays.raised - ray.y), pyramid_free.y);
    float tau = land_free(shore_place(vec2(0.0)), u_eye_height, ray, rays.aside, rays.raised, enter, rays.reach);
    return vec3(0.0, min(tau, rays.reach), 0.0);
}
