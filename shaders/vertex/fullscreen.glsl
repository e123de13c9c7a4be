// One triangle that covers the target, at depth FULLSCREEN_DEPTH in clip space.
void main() {
    vec2 corner = vec2(float((gl_VertexID & 1) << 2), float((gl_VertexID & 2) << 1));
    gl_Position = vec4(corner - 1.0, FULLSCREEN_DEPTH, 1.0);
}
