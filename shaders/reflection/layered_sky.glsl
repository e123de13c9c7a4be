// Water mirrors the sky alone, its clouds blurred. r: reflected direction, over the horizon; d: from the eye; n: normal; unit vectors.
vec3 reflected_light(vec3 r, vec3 d, vec3 n) {
    return sky_seen(r, SKY_MIRROR);
}
