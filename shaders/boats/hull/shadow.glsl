// The sun's light past boats: none under a hull, some through a sail. docs/formulae.md, section 15.
// place: m from under the eye, y over still water.
float sunlit(vec3 place, Footprint fp) {
    float t;
    BoatHit hit;
    if (trace_boats(place, u_sun_direction, 0.0, 1e4, false, t, hit) < 0) {
        return open_sun(place, fp);
    }
    return hit.part == PART_SAIL ? SUN_UNDER_SAIL * open_sun(place, fp) : 0.0;
}
