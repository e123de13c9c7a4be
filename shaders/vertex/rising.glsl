// One triangle, at depth FULLSCREEN_DEPTH in clip space, over what falling.glsl leaves.
void main() {
    gl_Position = vec4(horizon_corner(-1.0), FULLSCREEN_DEPTH, 1.0);
}
