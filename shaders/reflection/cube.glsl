// The sky kept in a cube map.

// @part texel
// Texel of a face of the cube map.
uniform sampler2D u_cube;

vec4 cube_texel(int face, ivec2 at) {
    return texel_at(u_cube, ivec2(face % 3, face / 3) * CUBE_SIZE + at);
}

// @part cube
// A cube of directions in one picture, three faces above three. Texels at a face's rim look along its edge, and so belong to both faces:
// no seam.

// Toward a place of a face, in [-1, 1] along its sides.
vec3 cube_direction(int face, vec2 at) {
    float side = (face & 1) == 0 ? 1.0 : -1.0;
    return face < 2 ? vec3(side, at.x, at.y) : face < 4 ? vec3(at.y, side, at.x) : vec3(at.x, at.y, side);
}

// The face that a direction meets, and where: in texels from the face's first.
vec2 cube_place(vec3 d, out int face) {
    vec3 turned = cube_face(d, face);
    return clamp(turned.xy / turned.z * 0.5 + 0.5, 0.0, 1.0) * float(CUBE_SIZE - 1);
}

// @part cubemap
// Water mirrors a cube map, bilinear inside a face. r: reflected direction, a unit vector.
// place: where on the water, from under the eye, y over still water, m.
vec3 reflected_light(vec3 place, vec3 r, vec3 spread) {
    int face;
    vec2 at = cube_place(r, face);
    // By hand: a filter of the GPU would reach over the rim into the next face of the picture.
    ivec2 base = min(ivec2(at), ivec2(CUBE_SIZE - 2));
    vec2 t = at - vec2(base);
    return bilinear(
        cube_texel(face, base), cube_texel(face, base + ivec2(1, 0)),
        cube_texel(face, base + ivec2(0, 1)), cube_texel(face, base + ivec2(1, 1)), t).rgb;
}

// @part pass
// The six faces of the cube map, its sky as level water of this roughness mirrors it.
uniform float u_roughness; // root mean square slope

out vec4 o_light;

void main() {
    ivec2 texel = as_int(floor(gl_FragCoord.xy));
    ivec2 cell = texel / CUBE_SIZE;
    vec2 at = 2.0 * vec2(texel - cell * CUBE_SIZE) / float(CUBE_SIZE - 1) - 1.0;
    vec3 d = normalize(cube_direction(cell.x + 3 * cell.y, at));
    // Water mirrors nothing from under the horizon: half of the texels are never read.
    vec3 light = d.y < -0.1 ? vec3(0.0) : surroundings(d, 1.41421356 * u_roughness * vec3(1.0, length(vec2(d.y, u_roughness)), 0.0));
    o_light = vec4(min(light, BRIGHTEST), 1.0);
}
