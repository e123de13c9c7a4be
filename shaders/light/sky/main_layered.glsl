// The sky behind everything, and what stands beyond the air. Linear light; no foam.
out vec4 o_color;

void main() {
    vec3 ray = camera_ray(sample_place());
    vec3 d = normalize(ray);
    float hidden;
    vec3 air = behind_clouds(clear_sky(d), d, SKY_EYE, hidden);
    float pixel = 2.0 * length(u_ray_y) / (u_viewport.y * length(ray));
    vec4 moon = moon_disc(d);
    vec3 beyond = sun_disc(d) + moon.rgb + star_light(d, pixel) * (1.0 - moon.a);
    o_color = vec4(min(exposure() * (air + (1.0 - hidden) * beyond), BRIGHTEST), 0.0);
}
