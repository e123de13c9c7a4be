// One triangle, at depth FULLSCREEN_DEPTH in clip space, over what falling.glsl leaves.
void main() {
    gl_Position = vec4(over_crests() ? horizon_corner(-1.0) : vec2(2.0), FULLSCREEN_DEPTH, 1.0);
}
