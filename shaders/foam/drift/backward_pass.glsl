// Backward mapping: each texel goes back along the flow to where its water was when each generation came up, and takes what came up
// there. Every texel gets a value, whatever the step. r, g, b, a: the generations, the youngest first.
uniform sampler2D u_drift_way;   // the ways to the two youngest generations
uniform sampler2D u_drift_older; // where the others' water was whole quarters of a generation ago
uniform float u_drift_texel;     // m
uniform float u_drift_coverage;  // mean of a patch
out vec4 o_drift;

void main() {
    vec2 here = gl_FragCoord.xy * u_drift_texel - u_drift_half;
    vec4 way = texel_at(u_drift_way, ivec2(gl_FragCoord.xy));
    vec4 older = DRIFT_GENERATIONS > 2 ? texel_at(u_drift_older, drift_still_texel()) : vec4(0.0);
    vec4 found = vec4(0.0);
    for (int j = 0; j < DRIFT_GENERATIONS; ++j) {
        vec2 q = j == 0 ? here + way.xy : j == 1 ? here + way.zw : drift_rest(j == 2 ? older.xy : older.zw);
        // Four places of the texel, whose ways differ as their neighbours' do: filaments finer than texels would break into beads.
        vec2 x = dFdx(q);
        vec2 y = dFdy(q);
        uint generation = drift_generation(j);
        float sum = 0.0;
        for (int i = 0; i < 4; ++i) {
            vec2 part = 0.25 * vec2(float(2 * (i & 1) - 1), float(2 * (i >> 1) - 1));
            sum += 0.25 * drift_patch(generation, q + part.x * x + part.y * y);
        }
        // What the flow has wound finer than these is its mean.
        float reach = max(length(x), length(y)) * u_drift_scale;
        found[j] = mix(sum, u_drift_coverage, smoothstep(0.5, 2.0, reach));
    }
    o_drift = found;
}
