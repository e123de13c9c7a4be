// Foam that several masks share. What none of them covers stays free, and masks that know nothing of each other leave the product of
// what each leaves free: (1 - s1)(1 - s2) = 1 - s for 1 - si = (1 - s)^wi, w1 + w2 = 1. docs/formulae.md, section 5.

// What a cover s in [0, 1] leaves free: x * y. A power below 1 has an endless slope at 0: x, under the power, is held there, and y leads
// it to 0 evenly, so that all is covered where s is 1.
vec2 cover_free(float s) {
    float left = 1.0 - s;
    return vec2(max(left, 1.0 / 256.0), smoothstep(0.0, 1.0 / 256.0, left));
}

// The cover of a mask of weight w.
float cover_part(vec2 free, float w) {
    return 1.0 - pow(free.x, w) * free.y;
}
