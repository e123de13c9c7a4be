// The same a generation and two generations before the older of those.
uniform sampler2D u_drift_still;
out vec4 o_still;

void main() {
    vec2 third = drift_ago(texel_at(u_drift_still, ivec2(gl_FragCoord.xy)).zw, DRIFT_GENERATION);
    o_still = vec4(third, drift_ago(third, DRIFT_GENERATION));
}
