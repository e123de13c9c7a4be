// The march toward water at a coast, and its bounds.

// @part beyond
// Beyond the square of the shore the sea is open, and less steep.
uniform vec2 u_shore_bounds; // slope and second derivative (1/m) that the shore adds

// tau from which on no ray up to `aside` metres a unit beside this one is in the square; and what the bounds are less by from there.
vec3 surface_beyond(vec3 ray, float aside) {
    return vec3(shore_leaves(shore_place(vec2(0.0)), ray.xz, aside), u_shore_bounds);
}

// @part reach
// Way to the shore's floor along d (unit) from a place at height y, m. 0 inside ground.
float bed_reach(vec2 p, float y, vec3 d) {
    vec2 q = shore_place(p);
    float fine = march_tolerance();
    float leave = d.y > 0.0 ? min(max(u_shore_top - y, 0.0) / d.y, 1e5) : 1e5;
    float reach = 0.0;
    float before;
    float gap;
    vec4 ground;
    march_ground(q, y, d, leave, fine, 0.0, false, reach, before, gap, ground);
    // What the steps did not reach is far, or never comes.
    if (d.y > 0.0 && gap >= fine * reach) {
        return 1e6;
    }
    refine_ground(q, y, d, 1.0, fine, 0.0, 3, false, reach, gap, ground);
    return min(reach, 1e6);
}

// @part approach
// A march over the open sea to the square of the shore, where the shore's waves need not be looked at. It ends at the square, at `leave`, or
// where the surface is met.
void march_open(vec3 ray, float leave, float fine, vec3 now, vec2 less, float bend, inout float tau) {
    vec2 span = shore_span(shore_place(vec2(0.0)), ray.xz);
    float outside = min(span.x < span.y ? span.x : 1e30, leave);
    for (int i = 0; i < MARCH_STEPS; ++i) {
        if (tau >= outside) {
            break;
        }
        vec3 wave = open_waves(tau * ray.xz);
        float gap = u_eye_height + tau * ray.y - wave.x;
        float rate = ray.y - dot(wave.yz, ray.xz);
        if (gap < fine * tau && (gap < 0.0 || rate < 0.0)) {
            break;
        }
        tau = min(tau + march_ahead(ray, tau, gap, rate, fine, now, less, bend), outside);
    }
}

// @part march
// Rays to land and sea floor. A ray: q + tau ray.xz, metres from the middle of the square; height + tau ray.y, over y = 0.
// docs/formulae.md, sections 8 and 10.

// Where a ray is inside the square and between y = 0 and the highest land: from x to y; nowhere, where y is not more than x.
vec2 land_span(vec2 q, float height, vec3 ray) {
    vec2 span = shore_span(q, ray.xz);
    float enter = span.x;
    float leave = span.y;
    float over = height - u_shore_top;
    float fall = abs(ray.y) < 1e-9 ? -1e-9 : ray.y;
    // A rising ray leaves through the top, a falling one enters there and leaves at y = 0, where the sea begins.
    if (over > 0.0) {
        enter = max(enter, ray.y < 0.0 ? over / -fall : 1e30);
    } else if (ray.y > 0.0) {
        leave = min(leave, -over / fall);
    }
    if (ray.y < 0.0) {
        leave = min(leave, height / -fall);
    }
    return vec2(enter, leave);
}

// Steps that cannot pass the ground, until the ray is less than fine (near + tau) over it or past `leave`. before: the last place but one;
// gap: height over the ground, which is met there.
// dry: only land over y = 0 counts, and a ray that brushes a ridge does not spend all its steps there: with the last half it goes on to
// `leave`.
void march_ground(
    vec2 q, float height, vec3 ray, float leave, float fine, float near, bool dry,
    inout float tau, out float before, out float gap, out vec4 ground) {
    float level = length(ray.xz);
    float slowest = 1e-6 * length(ray);
    float fastest = max(u_shore_steepest[0] * level - ray.y, slowest);
    float fastest_dry = max(u_shore_steepest[1] * level - ray.y, slowest);
    before = tau;
    gap = 0.0;
    for (int i = 0; i < MARCH_STEPS; ++i) {
        ground = shore_floor(q + tau * ray.xz);
        gap = height + tau * ray.y - ground.x;
        if (gap < fine * (near + tau) || tau >= leave) {
            break;
        }
        before = tau;
        tau += gap / fastest;
        if (dry) {
            // Land over y = 0 is gentler than the floor, and lower than the ray by no more than the ray's own height.
            tau = max(tau, before + min(gap, height + before * ray.y) / fastest_dry);
            float rate = ray.y - dot(ground.yz, ray.xz);
            tau = max(tau, before + safe_step(gap, 0.0, rate, 1e30, u_shore_bend * level * level));
        }
        if (dry && 2 * i >= MARCH_STEPS) {
            tau = max(tau, before + (leave - before) / float(MARCH_STEPS - i));
        }
    }
}

// @part start
// How far the rays between ray - side - top and ray + side + top are free of land over y = 0.
vec3 land_start(vec3 ray, vec3 side, vec3 top) {
    Pyramid rays = pyramid(ray, side, top);
    float enter = max(pyramid_enters(rays, u_eye_height - u_shore_top, rays.raised - ray.y), pyramid_free.y);
    float tau = land_free(shore_place(vec2(0.0)), u_eye_height, ray, rays.aside, rays.raised, enter, rays.reach);
    return vec3(0.0, min(tau, rays.reach), 0.0);
}

// @part maxima
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
        vec2 maxima = texel_at(u_land_maxima, as_int(cell) + ivec2(left, 0)).rg;
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

// @part maxima_pass
// How high land stands at most in the cells of the tree. From the texels that its B-spline reads in a cell and a little beyond its
// walls, which it never passes.
uniform sampler2D u_shore_floor; // height (m), tint
out vec4 o_highest;

void main() {
    ivec2 cell = as_int(floor(gl_FragCoord.xy));
    ivec2 level = land_level(cell.x);
    cell.x -= level.y;
    o_highest = vec4(0.0);
    if (level.x < LAND_COARSEST || cell.y >= level.x) {
        return;
    }
    int side = FLOOR_TEXELS / level.x;
    float highest = 0.0;
    for (int j = -2; j <= side + 1; ++j) {
        for (int i = -2; i <= side + 1; ++i) {
            ivec2 texel = clamp(side * cell + ivec2(i, j), ivec2(0), ivec2(FLOOR_TEXELS - 1));
            highest = max(highest, texel_at(u_shore_floor, texel).r);
        }
    }
    o_highest = vec4(highest, 0.0, 0.0, 0.0);
}
