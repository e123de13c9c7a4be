// Nothing but the sky stands around. r: unit vector.
vec3 surroundings(vec3 r) {
    return mirrored_sky(r);
}
