// The wakes of all boats, a band of rows each: height (m), slopes behind and aside, mean square wavenumber.
out vec4 o_wake;

void main() {
    int rows = WAKE_SIZE / 2;
    int i = int(gl_FragCoord.y) / rows;
    vec2 at = vec2(gl_FragCoord.x / float(WAKE_SIZE), (gl_FragCoord.y - float(i * rows)) / float(rows) * WAKE_ASIDE) * u_wake[i].z;
    o_wake = wake_pattern(at, u_wake[i], u_wake_boat[i].x, u_wake_boat[i].y);
}
