// How far a beam is free of land over y = 0, by a tree of the heights that land reaches at most: a fetch a cell, in cells as large as
// may be. docs/formulae.md, section 8.

// q: where the beam begins, metres from the middle of the square, y m high; r: its middle ray; it spreads by `aside` m a unit level
// and by `raised` upright. Nothing is looked for before `from` and beyond `leave`; at least 0.
float land_free(vec2 q, float y, vec3 r, float aside, float raised, float from, float leave) {
    vec2 sense = vec2(r.x < 0.0 ? -1.0 : 1.0, r.z < 0.0 ? -1.0 : 1.0);
    vec2 level_speed = max(abs(r.xz), 1e-9);
    vec2 enters = max(-0.5 * u_shore_size - sense * q, 0.0) / (level_speed + aside);
    float tau = max(max(enters.x, enters.y), from);
    float last = min(leave, shore_leaves(q, r.xz, aside));
    float sinks = raised - r.y;
    int cells = LAND_CELLS / 4;
    int left = 2 * LAND_CELLS - 2 * cells;
    for (int i = 0; i < LAND_ROUNDS; ++i) {
        if (tau >= last) {
            break;
        }
        float side = u_shore_size / float(cells);
        vec2 at = q + tau * r.xz;
        vec2 cell = clamp(floor(at / side + 0.5 * float(cells)), vec2(0.0), vec2(float(cells - 1)));
        vec2 maxima = texel_at(u_land_maxima, ivec2(cell) + ivec2(left, 0)).rg;
        float highest = aside > 0.0 ? maxima.g : maxima.r;
        // To the cell's far walls, a little over, as long as the beam is no wider than a cell on either side; from outside the square
        // no further than to the walls of the cell that is next to it.
        vec2 walls = (cell + 0.5 + 0.5 * sense) * side - 0.5 * u_shore_size;
        vec2 way = max(sense * (walls - at), 0.0) + 1e-3 * side;
        float ends = tau + min(way.x / level_speed.x, way.y / level_speed.y);
        ends = min(ends, side / max(aside, 1e-9));
        bool wide = aside * tau >= side;
        float lowest = y - sinks * (sinks > 0.0 ? ends : tau);
        if (!wide && lowest > highest) {
            tau = max(ends, tau);
            if (cells > LAND_COARSEST) {
                left += cells;
                cells >>= 1;
            }
        } else if (!wide && cells < LAND_CELLS) {
            cells <<= 1;
            left -= cells;
        } else {
            // As far as it stays over the cell.
            if (!wide && sinks > 0.0) {
                tau = clamp((y - highest) / sinks, tau, ends);
            }
            break;
        }
    }
    return tau < last ? tau : max(tau, leave);
}
