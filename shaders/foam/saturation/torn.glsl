// Torn foam under a footprint: noise keeps of itself what its correlation, taken as normal, keeps in the mean over the footprint, and
// the step that makes patches of it is as much wider as what is not resolved varies. docs/formulae.md, section 8.

// No noise yet: mean and unresolved variance.
const vec2 TORN_NONE = vec2(0.5, 0.0);

// sum: mean and unresolved variance so far. share: of this noise in the sum; cell: its side, lengths as of the footprint.
vec2 torn_noise(vec2 sum, float share, float cell, float noise, Footprint fp) {
    // 3.23: mean square change of noise_value a cell over its variance, 0.046.
    float per = (3.23 / 12.0) / (cell * cell);
    float area = per * (fp.x.x * fp.y.y - fp.x.y * fp.y.x);
    float kept = 1.0 / (1.0 + per * (dot(fp.x, fp.x) + dot(fp.y, fp.y)) + area * area);
    return sum + share * vec2(sqrt(kept) * (noise - 0.5), share * 0.046 * (1.0 - kept));
}

// Mean of smoothstep(low, high, x) over an x of this variance. A smoothstep is the share of a parabola's weight, whose
// variance is a fifth of the square of its half width: as wide as both together.
float torn_step(float low, float high, float x, float variance) {
    float middle = 0.5 * (low + high);
    float reach = sqrt(0.25 * (high - low) * (high - low) + 5.0 * variance);
    return smoothstep(middle - reach, middle + reach, x);
}

// Variance under the footprint of what changes by so much a unit.
float torn_variance(vec2 change, float unit, Footprint fp) {
    vec2 turns = vec2(dot(change, fp.x), dot(change, fp.y)) / unit;
    return dot(turns, turns) / 12.0;
}
