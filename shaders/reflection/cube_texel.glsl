// Texel of a face of the cube map.
uniform sampler2D u_cube;

vec4 cube_texel(int face, ivec2 at) {
    return texel_at(u_cube, ivec2(face % 3, face / 3) * CUBE_SIZE + at);
}
