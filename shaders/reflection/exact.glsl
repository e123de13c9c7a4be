// Water mirrors what stands around, found anew for each sample. r: reflected direction, a unit vector.
// place: where on the water, from under the eye, y over still water, m.
vec3 reflected_light(vec3 place, vec3 r, vec3 spread) {
    return surroundings(r, spread);
}
