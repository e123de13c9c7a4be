// The surface where an earlier pass has found it: 1 where the ray meets water, 2 where it meets land.
uniform sampler2D u_met; // tau, and which of them

bool find_surface(vec3 ray, float farthest, out float tau, out vec3 wave) {
    vec2 met = texelFetch(u_met, ivec2(sample_place()), 0).rg;
    tau = met.r;
    wave = waves(tau * ray.xz);
    return met.g == 1.0;
}
