// The sky behind everything. Linear light; no foam.
out vec4 o_color;

void main() {
    vec3 d = normalize(camera_ray(sample_place()));
    o_color = vec4(min(exposure() * (sky_light(d) + sun_disc(d)), BRIGHTEST), 0.0);
}
