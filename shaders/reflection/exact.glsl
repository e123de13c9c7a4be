// Water mirrors what stands around, found anew for each sample. r: reflected direction; d: from the eye; n: normal; unit vectors.
vec3 reflected_light(vec3 r, vec3 d, vec3 n) {
    return surroundings(r);
}
