// A corner of the refracted grid, drawn where its light lands, at half texels. The grid reaches past the tile by
// CAUSTIC_MARGIN cells.
// A corner is the last of two triangles, the provoking one: it brings them their areas, for derivatives of a varying would
// hang on how finely a driver places corners.
in vec2 a_grid;
out vec2 v_entered;        // column where it entered, in cells; light
flat out vec3 v_triangles; // area where it entered over area here of the triangle after this corner's column and before; the column

const float CAUSTIC_MOST = 12.0; // a triangle folded to nothing would be infinitely bright

vec3 landing_of(ivec2 corner) {
    vec3 landing = caustic_landing(corner + 2 * CAUSTIC_CELLS, CAUSTIC_CELLS);
    return vec3(vec2(corner) + landing.xy * (float(CAUSTIC_CELLS) / u_caustic_tile), landing.z);
}

float spread(vec2 a, vec2 b) {
    return 1.0 / max(abs(a.x * b.y - a.y * b.x), 1.0 / CAUSTIC_MOST);
}

void main() {
    ivec2 corner = ivec2(floor(a_grid * float(CAUSTIC_CELLS + 2 * CAUSTIC_MARGIN) + 0.5)) - CAUSTIC_MARGIN;
    vec3 here = landing_of(corner);
    vec2 before = landing_of(corner - ivec2(0, 1)).xy;
    vec2 after = landing_of(corner + ivec2(1, -1)).xy;
    vec2 left = landing_of(corner - ivec2(1, 0)).xy;
    v_entered = vec2(float(corner.x), here.z);
    v_triangles = vec3(spread(before - here.xy, after - here.xy), spread(before - here.xy, left - here.xy), float(corner.x));
    vec2 place = here.xy * (float(2 * CAUSTIC_TEXELS) / float(CAUSTIC_CELLS)) + float(CAUSTIC_RIM);
    gl_Position = vec4(place / float(CAUSTIC_TEXELS + CAUSTIC_RIM) - 1.0, 0.0, 1.0);
}
