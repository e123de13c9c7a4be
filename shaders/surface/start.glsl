// A march of the pyramid of rays between ray - side - top and ray + side + top to the water's surface, from the side that the eye
// is on: no step that any of the rays could not take. docs/formulae.md, section 3.
uniform float u_surface_trough; // no water is lower, m
uniform float u_surface_grain;  // what maps may add to the surface between their texels, m

vec3 water_start(vec3 ray, vec3 side, vec3 top) {
    float sense = u_eye_height < waves(vec2(0.0)).x ? -1.0 : 1.0;
    Pyramid rays = pyramid(ray, side, top);
    vec3 bounds = surface_bounds(ray, rays.aside, 0.0);
    // The ray that comes toward the surface the fastest.
    float toward = rays.raised - sense * ray.y;
    float over = sense > 0.0 ? u_eye_height - bounds.x : u_surface_trough - u_eye_height;
    float tau = max(pyramid_enters(rays, over, toward), pyramid_free.x);
    vec3 beyond = surface_beyond(ray, rays.aside);
    for (int i = 0; i < MARCH_STEPS; ++i) {
        if (tau >= rays.reach) {
            break;
        }
        vec3 wave = waves(tau * ray.xz);
        float gap = sense * (u_eye_height + tau * ray.y - wave.x);
        float rate = sense * (ray.y - dot(wave.yz, ray.xz));
        vec2 less = tau < beyond.x ? vec2(0.0) : beyond.yz;
        float steepest = bounds.y - less.x;
        float fastest = max(steepest * rays.speed + toward, 1e-6 * length(ray));
        // Crests are sharper than troughs: from below only slopes are told.
        float curvature = sense > 0.0 && bounds.z < 60000.0 ? bounds.z - less.y : 1e9;
        // As near as any ray of the pyramid can be: by the steepest slope, and by the slope here and the curvature.
        float sloped = gap - tau * (rays.raised + steepest * rays.aside);
        float tilted = abs(side.y - dot(wave.yz, side.xz)) + abs(top.y - dot(wave.yz, top.xz));
        float curved = gap - tau * (tilted + 0.5 * curvature * tau * rays.aside * rays.aside);
        float longest = max(sloped / fastest, 0.0);
        if (curved > 0.0) {
            float change = rate - tilted - curvature * rays.speed * tau * rays.aside;
            longest = max(longest, safe_step(curved, u_surface_grain, change, 1e30, curvature * rays.speed * rays.speed));
        }
        tau += longest;
        if (longest < START_SHARE * tau * rays.raised) {
            break;
        }
    }
    // What lies behind that place bends no ray of the tile any more.
    return vec3(min(tau, rays.reach), 0.0, surface_bounds(ray, rays.aside, tau).z);
}
