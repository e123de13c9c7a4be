// Rays that fall faster than this come to water within the farthest that is looked for (surface/march.glsl), from over it.
float water_rise() {
    return -1.1e-5 * max(u_eye_height, 0.0) * (length(u_ray_x.xz) + length(u_ray_y.xz) + length(u_ray_z.xz));
}
