// Patches that foam of the surf tears into, [0, 1]. q: where its water lies, from the middle of the square, m.
uniform float u_surf_life;  // time to 1/e, periods
uniform float u_surf_scale; // 1 / height of a breaking wave, 1/m

float surf_patches(vec2 q, Footprint fp) {
    vec2 turned = vec2(0.8 * q.x - 0.6 * q.y, 0.6 * q.x + 0.8 * q.y);
    vec2 torn = torn_noise(TORN_NONE, 0.4, 6.0, noise_value(NOISE_KEY, turned / 6.0), fp);
    torn = torn_noise(torn, 0.35, 1.7, noise_value(NOISE_KEY, q / 1.7), fp);
    torn = torn_noise(torn, 0.25, 0.5, noise_value(NOISE_KEY, turned / 0.5), fp);
    return torn_step(0.25, 0.72, torn.x, torn.y);
}
