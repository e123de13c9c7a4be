// The face of a cube that a direction meets: +x, -x, +y, -y, +z, -z. x and y along the face's sides, z toward it.
vec3 cube_face(vec3 d, out int face) {
    vec3 size = abs(d);
    if (size.x >= size.y && size.x >= size.z) {
        face = d.x > 0.0 ? 0 : 1;
        return vec3(d.y, d.z, size.x);
    }
    if (size.y >= size.z) {
        face = d.y > 0.0 ? 2 : 3;
        return vec3(d.z, d.x, size.y);
    }
    face = d.z > 0.0 ? 4 : 5;
    return vec3(d.x, d.y, size.z);
}
