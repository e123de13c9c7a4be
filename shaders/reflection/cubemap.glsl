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
