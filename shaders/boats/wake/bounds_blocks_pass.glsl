// What a wake's map holds at most in blocks of its texels: height (m), slope, second derivative where troughs turn up (1/m), as they
// lie on the water: inside the boat's circle the way behind it is drawn together. docs/formulae.md, section 3.
uniform sampler2D u_wake_map;
out vec4 o_bounds;

void main() {
    int rows = WAKE_SIZE / 2;
    ivec2 corner = ivec2(gl_FragCoord.xy) * BOUNDS_BLOCK;
    int i = corner.y / rows;
    vec2 texel = u_wake[i].z * vec2(1.0 / float(WAKE_SIZE), WAKE_ASIDE / float(rows));
    float radius = u_wake_boat[i].y;
    vec3 bounds = vec3(0.0);
    for (int y = 0; y < BOUNDS_BLOCK; ++y) {
        int row = corner.y - i * rows + y;
        // No place is nearer to the centre than a tenth of the radius.
        float closer = radius / max(radius - float(row + 1) * texel.y, 0.1 * radius);
        for (int x = 0; x < BOUNDS_BLOCK; ++x) {
            ivec2 at = corner + ivec2(x, y);
            vec3 here = texelFetch(u_wake_map, at, 0).xyz;
            vec3 behind = texelFetch(u_wake_map, ivec2(min(at.x + 1, WAKE_SIZE - 1), at.y), 0).xyz;
            // Half a texel from the course each side is the other's mirror image; beyond the last row there is no wake.
            vec3 aside = row + 1 < rows ? texelFetch(u_wake_map, at + ivec2(0, 1), 0).xyz : vec3(0.0);
            vec3 along = (behind - here) / texel.x;
            vec3 across = (aside - here) / texel.y;
            float xx = along.y * closer * closer;
            float yy = across.z;
            float xy = 0.5 * (along.z + across.y) * closer;
            float bend = 0.5 * (xx + yy) + sqrt(0.25 * (xx - yy) * (xx - yy) + xy * xy);
            float steep = max(length(vec2(here.y * closer, here.z)), length(vec2(along.x * closer, across.x)));
            if (row == 0) {
                bend = max(bend, 2.0 * here.z / texel.y);
            }
            // On a circle straight ways turn against the course.
            bounds = max(bounds, vec3(here.x, steep, bend + 2.0 * closer * steep / radius));
        }
    }
    o_bounds = vec4(bounds, 0.0);
}
