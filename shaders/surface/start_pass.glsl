// How far all rays of a tile of the picture are free. docs/formulae.md, section 3.
out vec4 o_start;

void main() {
    pyramid_free = known_free();
    // From the middle ray to the tile's sides; a thousandth more, so that no rounding leaves a ray out.
    vec3 found = starts(camera_ray(gl_FragCoord.xy), 1.001 * u_ray_x / u_viewport.x, 1.001 * u_ray_y / u_viewport.y);
    // Half floats hold it all: the way to water in two, what they round on the safe side. No curvature that they cannot hold is told.
    float tau = min(found.r, 65000.0);
    float whole = unpackHalf2x16(packHalf2x16(vec2(tau, 0.0))).x;
    float rest = (tau - whole) - 1e-6 * tau;
    o_start = vec4(whole, rest, min(0.9994 * found.g, 65000.0), found.b > 60000.0 ? 65000.0 : 1.0006 * found.b + 1e-6);
}
