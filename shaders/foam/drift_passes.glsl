// Maps of drift: the way of the flow forward and backward, and foam that has stood still.

// @part flow
// The velocity map: m/s over the square.
uniform float u_drift_texel; // m
out vec4 o_flow;

void main() {
    o_flow = vec4(drift_velocity(gl_FragCoord.xy * u_drift_texel - u_drift_half), 0.0, 0.0);
}

// @part start
// Forward mapping, its start: what came up in each cell, every generation in a channel of its own.
uniform float u_drift_texel; // m
out vec4 o_drift;

void main() {
    vec2 q = gl_FragCoord.xy * u_drift_texel - u_drift_half;
    vec4 found = vec4(0.0);
    for (int j = 0; j < DRIFT_GENERATIONS; ++j) {
        found[j] = drift_patch(drift_generation(j), q);
    }
    o_drift = found;
}

// @part coarse
// The map's means over 4 x 4 texels, for places that are far away.
uniform sampler2D u_drift_map;
out vec4 o_drift;

void main() {
    ivec2 base = 4 * as_int(floor(gl_FragCoord.xy));
    vec4 sum = vec4(0.0);
    for (int i = 0; i < 16; ++i) {
        sum += texelFetch(u_drift_map, base + ivec2(i & 3, i >> 2), 0);
    }
    o_drift = sum / 16.0;
}

// @part forward_vertex
// Forward mapping, one step (particle maps): the foam of a cell goes from the cell's middle along the flow into the cell where it ends. A
// step shorter than half a cell leads nowhere, and cells that no way leads to stay empty. One point a cell and generation.
uniform sampler2D u_drift_from;
uniform float u_drift_texel; // m
flat out vec4 v_foam;

void main() {
    int j = gl_VertexID & 3;
    ivec2 cell = ivec2((gl_VertexID >> 2) % DRIFT_SIZE, (gl_VertexID >> 2) / DRIFT_SIZE);
    vec4 only = vec4(equal(ivec4(0, 1, 2, 3), ivec4(j)));
    v_foam = only * texel_at(u_drift_from, cell);
    vec2 q = (vec2(cell) + 0.5) * u_drift_texel - u_drift_half;
    q += drift_velocity(q) * drift_age(j) / float(DRIFT_MOVES);
    // What has nothing to carry is drawn nowhere.
    gl_Position = dot(v_foam, only) > 0.0 ? vec4(q / u_drift_half, 0.0, 1.0) : vec4(2.0, 2.0, 0.0, 1.0);
    gl_PointSize = 1.0;
}

// @part forward
// Foam that ends in a cell, added up.
flat in vec4 v_foam;
out vec4 o_drift;

void main() {
    o_drift = v_foam;
}

// @part backward
// Backward mapping: each texel goes back along the flow to where its water was when each generation came up, and takes what came up
// there. Every texel gets a value, whatever the step. r, g, b, a: the generations, the youngest first.
uniform sampler2D u_drift_way;   // the ways to the two youngest generations
uniform sampler2D u_drift_older; // where the others' water was whole parts of a generation ago
uniform float u_drift_texel;     // m
uniform float u_drift_coverage;  // mean of a patch
out vec4 o_drift;

void main() {
    vec2 here = gl_FragCoord.xy * u_drift_texel - u_drift_half;
    vec4 way = texel_at(u_drift_way, as_int(floor(gl_FragCoord.xy)));
    vec4 older = vec4(0.0);
    if (DRIFT_GENERATIONS > 2) {
        vec4 before = drift_still_at(u_drift_older, 0);
        vec4 after = drift_still_at(u_drift_older, 1);
        older = vec4(drift_between(before.xy, after.xy), drift_between(before.zw, after.zw));
    }
    vec4 found = vec4(0.0);
    for (int j = 0; j < DRIFT_GENERATIONS; ++j) {
        vec2 q = j == 0 ? here + way.xy : j == 1 ? here + way.zw : j == 2 ? older.xy : older.zw;
        // Four places of the texel, whose ways differ as their neighbours' do: filaments finer than texels would break into beads.
        vec2 x = dFdx(q);
        vec2 y = dFdy(q);
        uint generation = drift_generation(j);
        float reach = max(length(x), length(y)) * u_drift_scale;
        int places = reach > 0.1 ? 4 : 1;
        float sum = 0.0;
        for (int i = 0; i < places; ++i) {
            vec2 part = places == 1 ? vec2(0.0) : 0.25 * vec2(float(2 * (i & 1) - 1), float(2 * (i >> 1) - 1));
            sum += drift_patch(generation, q + part.x * x + part.y * y) / float(places);
        }
        // What the flow has wound finer than these is its mean.
        found[j] = mix(sum, u_drift_coverage, smoothstep(0.5, 2.0, reach));
    }
    o_drift = found;
}

// @part still
// Where the water of a texel was some parts of a generation ago, and a generation before that; m from the square's middle. The flow is
// steady, so this has no time in it: a frame reads what lies between. The parts, from none to DRIFT_PARTS, lie one over the other.
uniform float u_drift_texel; // m
out vec4 o_still;

void main() {
    int part = as_int(floor(gl_FragCoord.y)) / DRIFT_SIZE;
    vec2 q = vec2(gl_FragCoord.x, gl_FragCoord.y - float(part * DRIFT_SIZE)) * u_drift_texel - u_drift_half;
    vec2 first = drift_ago(q, float(part) * (DRIFT_GENERATION / float(DRIFT_PARTS)));
    o_still = vec4(first, drift_ago(first, DRIFT_GENERATION));
}

// @part still_older
// The same a generation and two generations before the older of those.
uniform sampler2D u_drift_still;
out vec4 o_still;

void main() {
    vec2 third = drift_ago(texel_at(u_drift_still, as_int(floor(gl_FragCoord.xy))).zw, DRIFT_GENERATION);
    o_still = vec4(third, drift_ago(third, DRIFT_GENERATION));
}

// @part way
// The ways back to where the two youngest generations came up, m: r, g the youngest's, b, a the next.
uniform float u_drift_texel;     // m
uniform sampler2D u_drift_still; // where it was whole parts of a generation ago, and a generation before that
out vec4 o_way;

void main() {
    vec2 q = gl_FragCoord.xy * u_drift_texel - u_drift_half;
    vec4 before = drift_still_at(u_drift_still, 0);
    vec4 after = drift_still_at(u_drift_still, 1);
    o_way = vec4(drift_between(before.xy, after.xy) - q, drift_between(before.zw, after.zw) - q);
}
