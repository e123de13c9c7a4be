// How far all rays of a tile of the picture are free. docs/formulae.md, section 3.
out vec4 o_start;

void main() {
    // From the middle ray to the tile's sides; a thousandth more, so that no rounding leaves a ray out.
    vec4 found = starts(camera_ray(gl_FragCoord.xy), 1.001 * u_ray_x / u_viewport.x, 1.001 * u_ray_y / u_viewport.y);
    // As half floats round them they still lie on the safe side.
    o_start = min(found * vec4(0.9994, 0.9994, 1.0006, 1.0006), 65000.0);
}
