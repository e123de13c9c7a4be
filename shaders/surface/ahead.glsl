// How far a march may go from a place that it has looked at, so that no crest stands over the ray between by more than the tolerance.
// gap: height over the surface there, m; rate: its change a unit of the ray; now: surface_now(); less: what slope and second derivative are
// less by there; bend: second derivative of the surface at most, 1/m.
float march_ahead(vec3 ray, float tau, float gap, float rate, float fine, vec3 now, vec2 less, float bend) {
    float speed = length(ray.xz);
    float fastest = max((now.x - less.x) * speed - ray.y, 1e-6 * length(ray));
    float curvature = (bend - less.y) * speed * speed;
    float sure = max(gap, 0.0) + fine * tau;
    float longest = safe_step(sure, u_surface_grain, rate, fastest, curvature);
    if (SHORT_WAVES) {
        // Over the short waves' highest crest only the long ones count.
        vec3 few = short_waves();
        float bends = curvature - now.z * speed * speed;
        longest = max(longest, safe_step(sure + few.x - now.y, u_surface_grain, rate + dot(few.yz, ray.xz), 1e30, bends));
    }
    return longest;
}
