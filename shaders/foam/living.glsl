// Foam that ages: its carried mask coordinates, and rows along the wind.

// @part living
// Foam that lives: it lies where its water rests, gathers in rows along the wind, and its mask is that of its age. docs/formulae.md, section 5.

// s: share that is covered in the mean; f: saturation, which tells the age. lying: where the water rests.
float lying_amount(float s, float f, vec2 lying, Footprint fp) {
    if (FOAM_MASKS > 1) {
        // What is whole when it is born decays as e^-age, so its age is -log f. Masks follow one another, and two share what is covered.
        float age = clamp(-log(max(f, 1e-6)) / FOAM_AGE, 0.0, float(FOAM_MASKS - 1));
        float first = min(floor(age), float(FOAM_MASKS - 2));
        foam_mask = as_int(first);
        float share = smoothstep(0.35, 0.65, age - first);
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

// @part windrows
// Rows along the wind in which foam gathers: ridges of gradient noise, eight times as long as they are apart; mean 0, in [-1, 1].
// docs/formulae.md, section 5. The place is reduced in float64; the noise repeats after 256 cells.
uniform float u_windrow_phase[2]; // the eye's place in the noise, along the wind and across it; rad, a turn is 256 cells
uniform vec4 u_windrow_matrix;    // rows of the turn, in cells, 1/m
uniform float u_windrows;

float windrow(vec2 p, Footprint fp) {
    mat2 turn = transpose(mat2(u_windrow_matrix.xy, u_windrow_matrix.zw));
    float kept = 1.0;
    if (SURFACE_FILTER) {
        vec2 x = turn * fp.x;
        vec2 y = turn * fp.y;
        kept = 1.0 - smoothstep(0.15, 0.6, sqrt(max(dot(x, x), dot(y, y))));
        if (kept <= 0.0) {
            return 0.0;
        }
    }
    vec2 place = vec2(u_windrow_phase[0], u_windrow_phase[1]) * 40.7436654315252 + turn * p;
    return u_windrows * kept * max(1.0 - WINDROW_RIDGE * abs(noise_2(place, uint(WINDROW_SEED))), -1.0);
}
