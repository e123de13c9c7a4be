// Heights from which the sun's upper and lower rim are seen over the land from the middle of a cell: the highest of the lines of sight that
// the floor along the way toward the sun touches, in steps that grow from 0.4 of a cell. docs/formulae.md, section 8.
uniform vec4 u_land_sun; // level unit vector toward the sun (x, z); how much sights of its upper and lower rim rise a metre
uniform float u_shore_top; // nothing is higher, m

const float SUNLIT_FARTHEST = 1.5; // longer than the diagonal of a square

vec2 sunlit_from(ivec2 cell) {
    float side = u_shore_size / float(LAND_CELLS);
    vec2 q = (vec2(cell) + 0.5) * side - 0.5 * u_shore_size;
    // Half floats hold it.
    vec2 highest = vec2(-6e4);
    for (int i = 0; i < SHADOW_STEPS; ++i) {
        float s = float(i) / float(SHADOW_STEPS - 1);
        float way = side + (SUNLIT_FARTHEST * u_shore_size - side) * s * (0.25 + 0.75 * s);
        if (u_shore_top - way * u_land_sun.w < highest.x) {
            break;
        }
        highest = max(highest, shore_floor(q + way * u_land_sun.xy).x - way * u_land_sun.zw);
    }
    return highest;
}
