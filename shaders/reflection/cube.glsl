// A cube of directions in one picture, three faces above three. Texels at a face's rim look along its edge, and so belong to both faces:
// no seam.

// Toward a place of a face, in [-1, 1] along its sides.
vec3 cube_direction(int face, vec2 at) {
    float side = face % 2 == 0 ? 1.0 : -1.0;
    return face < 2 ? vec3(side, at.x, at.y) : face < 4 ? vec3(at.y, side, at.x) : vec3(at.x, at.y, side);
}

// The face that a direction meets, and where: in texels from the face's first.
vec2 cube_place(vec3 d, out int face) {
    vec3 turned = cube_face(d, face);
    return clamp(turned.xy / turned.z * 0.5 + 0.5, 0.0, 1.0) * float(CUBE_SIZE - 1);
}
