// One triangle, at depth FULLSCREEN_DEPTH in clip space, over all that a ray to water goes through. Drivers without branches would shade
// the sky as water, to throw it away.
void main() {
    gl_Position = vec4(horizon_corner(1.0), FULLSCREEN_DEPTH, 1.0);
}
