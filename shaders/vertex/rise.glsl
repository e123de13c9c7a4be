// Rays of the picture that rise faster than this, m a unit, come to no water: from over it, since crests rise no steeper than the surface
// and no higher than its top. docs/formulae.md, section 3.
uniform float u_surface_top;
uniform float u_surface_grain; // what maps may add to the surface between their texels, m

float water_rise() {
    float top = min(surface_top_now(), u_surface_top) + u_surface_grain;
    float under_top = top - u_eye_height;
    float over_water = u_eye_height - waves(vec2(0.0)).x;
    if (over_water < 0.0) {
        return 1e9;
    }
    float steepest = surface_now().x * max(under_top, 0.0) / max(under_top + max(over_water - u_surface_grain, 0.0), 1e-6);
    return steepest * (length(u_ray_x.xz) + length(u_ray_y.xz) + length(u_ray_z.xz));
}
