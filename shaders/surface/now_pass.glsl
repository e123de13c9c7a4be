// What marches read of the surface's bounds as they are now: slope; the short waves' height and second derivative; top.
out vec4 o_now;

void main() {
    vec3 few = short_bounds();
    vec3 bounds = surface_bounds(vec3(0.0), 0.0, 0.0);
    // Half floats: what is added is rounded up, what is taken away is rounded down.
    o_now = vec4(1.001 * bounds.y, 1.001 * few.x, 0.999 * few.z, bounds.x + 0.001 * abs(bounds.x));
}
