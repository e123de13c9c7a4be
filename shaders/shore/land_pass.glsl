// Land where the samples' rays meet it. Linear light; no foam.
uniform sampler2D u_met; // tau, and what is there: 2 is land
out vec4 o_color;

void main() {
    vec2 met = texelFetch(u_met, ivec2(sample_place()), 0).rg;
    if (met.g != 2.0) {
        discard;
    }
    vec3 ray = camera_ray(sample_place());
    o_color = land_color(ray, normalize(ray), met.r, shore_floor(shore_place(met.r * ray.xz)));
}
