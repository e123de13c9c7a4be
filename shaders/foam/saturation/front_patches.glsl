// Fronts foam in patches: the waves' sum counts for more in some places than in others. The patches drift with the foam and change.
// docs/formulae.md, section 4.
uniform float u_front_patch_phase[3]; // the eye's place in the noise: x, z, time; rad, a turn is 256 cells
uniform vec2 u_front_patch;           // size of the largest, m; standard deviation, of the sum

float front_patch(vec2 q, Footprint fp) {
    vec3 place = vec3(u_front_patch_phase[0], u_front_patch_phase[1], u_front_patch_phase[2]) * 40.7436654315252;
    float width = FRONT_FILTERED ? sqrt(max(dot(fp.x, fp.x), dot(fp.y, fp.y))) / u_front_patch.x : 0.0;
    return u_front_patch.y * fractal_3(place + vec3(q / u_front_patch.x, 0.0), width, 3, uint(FRONT_SEED));
}
