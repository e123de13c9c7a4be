// One triangle, at depth FULLSCREEN_DEPTH in clip space, over what lies under the horizon; over the target where the eye is not above
// every crest. Drivers without branches would shade the sky as water, to throw it away.
void main() {
    vec2 corner = vec2(float((gl_VertexID & 1) << 2), float((gl_VertexID & 2) << 1)) - 1.0;
    gl_Position = vec4(over_crests() ? horizon_corner(1.0) : corner, FULLSCREEN_DEPTH, 1.0);
}
