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
