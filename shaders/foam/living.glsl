// Foam that lives: it lies where its water rests, gathers in rows along the wind, and its mask is that of its age. docs/formulae.md, section 5.

// s: share that is covered in the mean; f: saturation, which tells the age. lying: where the water rests.
float lying_amount(float s, float f, vec2 lying, Footprint fp) {
    if (FOAM_MASKS > 1) {
        // What is whole when it is born decays as e^-age, so its age is -log f. Masks follow one another, and two share what is covered.
        float age = clamp(-log(max(f, 1e-6)) / FOAM_AGE, 0.0, float(FOAM_MASKS - 1));
        foam_mask = min(int(age), FOAM_MASKS - 2);
        float share = smoothstep(0.35, 0.65, age - float(foam_mask));
        vec2 left = cover_free(s);
        foam_older = share > 0.0 ? cover_part(left, share) : 0.0;
        s = cover_part(left, 1.0 - share);
        if (share >= 1.0) {
            s = foam_older;
            foam_older = 0.0;
            foam_mask += 1;
        }
    }
    return young_amount(s, lying, fp);
}

float foam_share_lying(float f, vec2 p, Footprint fp) {
    float s = foam_share(f);
    return s + windrow(p, fp) * s * (1.0 - s);
}

float foam_amount(float f, vec2 p, Footprint fp) {
    return lying_amount(foam_share_lying(f, p, fp), clamp(f, 0.0, 1.0), p + carry(p), fp);
}
