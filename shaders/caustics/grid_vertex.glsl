// A corner of the refracted grid, drawn where its light lands. The grid reaches past the tile by CAUSTIC_MARGIN cells.
in vec2 a_grid;
out vec3 v_light; // place where it entered, in cells; light

void main() {
    ivec2 corner = ivec2(floor(a_grid * float(CAUSTIC_CELLS + 2 * CAUSTIC_MARGIN) + 0.5)) - CAUSTIC_MARGIN;
    vec3 landing = caustic_landing(corner + CAUSTIC_CELLS, CAUSTIC_CELLS);
    vec2 texel = (vec2(corner) / float(CAUSTIC_CELLS) + landing.xy / u_caustic_tile) * float(CAUSTIC_TEXELS);
    v_light = vec3(vec2(corner), landing.z);
    gl_Position = vec4(2.0 * (texel + float(CAUSTIC_RIM)) / float(CAUSTIC_TEXELS + 2 * CAUSTIC_RIM) - 1.0, 0.0, 1.0);
}
