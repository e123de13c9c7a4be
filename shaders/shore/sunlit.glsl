// Sunlight that land does not block.

// @part sunlit
// The sun's light past the land: how much of its disc is seen over it. docs/formulae.md, section 8.
// place: m from under the eye, y over still water.
uniform vec4 u_land_sun; // level unit vector toward the sun (x, z); how much sights of its upper and lower rim rise a metre

const float SUNLIT_SOFT = 0.25; // of a cell, how far an edge of the map is off

float land_sunlit(vec3 place, Footprint fp) {
    vec2 q = shore_place(place.xz);
    // From outside the square as from where the way to the sun enters it.
    vec2 enters = max(-0.5 * u_shore_size - sign(u_land_sun.xy) * q, 0.0) / max(abs(u_land_sun.xy), 1e-6);
    float way = max(enters.x, enters.y);
    SplineTaps taps = spline_taps(q + way * u_land_sun.xy, LAND_CELLS);
    vec2 seen = vec2(0.0);
    vec2 slope = vec2(0.0);
    for (int j = 0; j < 3; ++j) {
        for (int i = 0; i < 3; ++i) {
            vec2 here = spline_texel(u_land_maxima, LAND_CELLS, taps, i, j).ba;
            seen += taps.wx[i] * taps.wz[j] * here;
            slope += vec2(taps.sx[i] * taps.wz[j], taps.wx[i] * taps.sz[j]) * here.y;
        }
    }
    seen -= way * u_land_sun.zw;
    slope *= taps.scale;
    // A mean over the footprint: wider edges.
    float soft = 0.5 * (abs(dot(slope, fp.x)) + abs(dot(slope, fp.y))) + SUNLIT_SOFT * u_land_sun.w * u_shore_size / float(LAND_CELLS);
    return smoothstep(seen.x - soft, seen.y + soft, place.y);
}

// @part sunlit_from
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

// @part sunlit_from_none
// No shadows of land.
vec2 sunlit_from(ivec2 cell) {
    return vec2(0.0);
}
