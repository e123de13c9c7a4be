// Where the water of a texel was some quarters of a generation ago, and a generation before that; m from the square's middle. The flow is steady, so
// this has no time in it: a frame goes back from here by what is left. The quarters, DRIFT_PARTS of them, lie one over the other.
uniform float u_drift_texel; // m
out vec4 o_still;

void main() {
    int part = int(gl_FragCoord.y) / DRIFT_SIZE;
    vec2 q = vec2(gl_FragCoord.x, gl_FragCoord.y - float(part * DRIFT_SIZE)) * u_drift_texel - u_drift_half;
    vec2 first = drift_ago(q, float(part) * (DRIFT_GENERATION / float(DRIFT_PARTS)));
    o_still = vec4(first, drift_ago(first, DRIFT_GENERATION));
}
