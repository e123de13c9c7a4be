// Waves reach every coast at normal incidence. phase (periods); how much of their height is left where two coasts are as near, and on
// coasts that face away.
vec3 shore_arrival(ivec2 here, float d, vec2 g) {
    float steep = length(g);
    float ridge = smooth_between(0.3, 0.8, steep);
    float met = dot(-g / max(steep, 1e-6), u_surf_heading);
    float exposed = mix(1.0, smooth_between(-0.3, 0.7, met), u_surf_exposure);

    // Time to shore over the period, at the speed sqrt(g h) over a floor of even slope.
    float least = max(0.3 * u_surf_height, 0.05);
    float root = sqrt(least);
    float beyond = sqrt(least + u_shore_slope * max(d, 0.0));
    float phase = (2.0 * max(d, 0.0) / (root + beyond) + min(d, 0.0) / root) / (sqrt(9.81) * u_surf_period);
    return vec3(phase, ridge, exposed);
}
