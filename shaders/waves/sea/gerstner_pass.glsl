// Height and displacement D = -a k/|k| sin(theta) of a tile's waves, as coefficients of a cubic B-spline; (h, Dx, Dz), m.
out vec4 o_displaced;

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    vec3 sum = vec3(0.0);
    ivec2 waves = gerstner_waves(at.x / SEA_SIZE);
    for (int i = waves.x; i < waves.y; ++i) {
        vec2 turn = whole_sine_cosine(gerstner_theta(i, at, SEA_SIZE));
        sum += u_gerstner[i].z * vec3(turn.y, -turn.x * normalize(u_gerstner[i].xy));
    }
    o_displaced = vec4(sum, 0.0);
}
