// The share of the pixel that lies under the horizon: the rest is sky.
float below_horizon(vec2 p) {
    vec3 way = vec3(p.x, -u_eye_height, p.y);
    float per_pixel = 2.0 * (abs(u_ray_x.y) / u_viewport.x + abs(u_ray_y.y) / u_viewport.y);
    // What the ray falls, over what it falls from pixel to pixel.
    float falls = u_eye_height * dot(u_ray_z, u_ray_z) / max(dot(way, u_ray_z), 1e-6);
    return u_eye_height > 0.0 ? clamp(0.5 + falls / max(per_pixel, 1e-20), 0.0, 1.0) : 1.0;
}
