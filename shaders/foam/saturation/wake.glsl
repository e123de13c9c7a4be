// Foam of a boat's wake, and how it is torn.

// @part torn_exact
// Torn foam at a point, as in torn.glsl without a footprint.
const vec2 TORN_NONE = vec2(0.0);

vec2 torn_noise(vec2 sum, float share, float cell, float noise, Footprint fp) {
    return sum + vec2(share * noise, 0.0);
}

float torn_step(float low, float high, float x, float variance) {
    return smoothstep(low, high, x);
}

float torn_variance(vec2 change, float unit, Footprint fp) {
    return 0.0;
}

// @part torn
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

// @part contact
// White water along the water line of a moving hull: a band that widens aft and is densest at the bow. docs/formulae.md, section 15.
uniform vec3 u_contact_hull[BOAT_COUNT]; // half breadth, its fall with depth, height of the greatest breadth

float wake_contact(int i, vec2 p, float amount, float patches, Footprint fp) {
    vec4 form = u_boat_form[i];
    vec3 hull = u_contact_hull[i];
    vec2 ahead = boat_forward(i);
    vec2 from = (p - boat_place(i)) / form.x;
    vec2 at = vec2(dot(from, ahead), dot(from, vec2(-ahead.y, ahead.x)));
    // The hull's sides where level water meets them, heel and all: to first order the distance is what lacks over its change.
    float fine = hull.x / 0.3844;
    float x = at.x + 0.12;
    float y = form.w * at.y - hull.z;
    vec2 out_of = vec2(2.0 * fine * x, 2.0 * hull.y * form.w * y + (at.y < 0.0 ? -form.z : form.z));
    float change = length(out_of); // at least 0.3: no boat heels over 0.6 rad
    float away = (fine * x * x + hull.y * y * y + form.z * abs(at.y) - hull.x) / change;
    out_of /= change;
    // The sides end at the stem and at the transom.
    float half_beam = hull.x - hull.y * hull.z * hull.z;
    float stem = sqrt(half_beam / fine) - 0.12;
    float past = max(at.x - stem, -0.45 - at.x);
    if (past > away) {
        away = past;
        out_of = vec2(1.0, 0.0);
    }
    float aft = clamp((stem - at.x) / (stem + 0.45), 0.0, 1.0);
    float width = 2.0 * hull.x * (0.05 + 0.1 * aft) * (0.5 + patches);
    float across = torn_variance(out_of.x * ahead + out_of.y * vec2(-ahead.y, ahead.x), form.x, fp);
    float band = torn_step(-width, 0.0, away, across) - torn_step(0.4 * width, 1.4 * width, away, across);
    return amount * (1.0 - 0.6 * aft) * band * (0.3 + 0.9 * patches);
}

// @part contact_none
// No white water along hulls.
float wake_contact(int i, vec2 p, float amount, float patches, Footprint fp) {
    return 0.0;
}

// @part wake
// Foam of boats: the churned band behind the stern, dying away in patches, what the bow throws aside, and what lies along the hull. f in [0, WAKE_CAP].
uniform vec4 u_wake_foam[BOAT_COUNT]; // amount, way to 1/e (m), amount at the bow, amount along the hull

float wake_saturation(vec2 p, float height, Footprint fp) {
    float sum = 0.0;
    for (int i = 0; i < BOAT_COUNT; ++i) {
        vec4 foam = u_wake_foam[i];
        WakeWay way = wake_way(i, p);
        float size = u_boat_form[i].x;
        float x = way.behind / size;
        float z = abs(way.aside) / size;
        float past = x - 0.86;
        float along = torn_variance(way.on_behind, size, fp);
        float across = torn_variance(way.on_aside, size, fp);
        // Noise lies on the water: places are counted from the centre of the course, which stands still.
        vec2 on = (p + u_boat_course[i].xy) / size;
        vec2 turned = vec2(0.8 * on.x - 0.6 * on.y, 0.6 * on.x + 0.8 * on.y);
        vec2 torn = torn_noise(TORN_NONE, 0.4, 0.31 * size, noise_value(NOISE_KEY, on / 0.31), fp);
        torn = torn_noise(torn, 0.35, 0.11 * size, noise_value(NOISE_KEY, turned / 0.11), fp);
        torn = torn_noise(torn, 0.25, 0.037 * size, noise_value(NOISE_KEY, on / 0.037), fp);
        float patches = torn_step(0.25, 0.72, torn.x, torn.y);
        float width = 0.085 + 0.055 * sqrt(max(past, 0.0));
        // Between both its rims, either of which a wide footprint sees.
        float band = torn_step(-1.15 * width, -0.5 * width, z, across) - torn_step(0.5 * width, 1.15 * width, z, across);
        band *= torn_step(-0.06, 0.04, past, along);
        float age = exp(-min(max(past, 0.0) * size / foam.y, 80.0));
        float run = min(x / 0.55, 1.0);
        float edge = 0.015 + 0.105 * run * (2.0 - run) + 0.16 * max(x - 0.55, 0.0);
        float reach = 0.02 + 0.025 * max(x, 0.0);
        float off = (z - edge) / reach;
        // A bell over a normal spread is a wider bell.
        float wider = 1.0 + 2.0 * across / (reach * reach);
        float thrown = torn_step(-0.01, 0.06, x, along) * exp(-min(off * off / wider + 1.3 * max(x, 0.0), 80.0)) * inversesqrt(wider);
        sum += foam.x * band * age * (0.3 + 0.9 * patches) + foam.z * thrown * (0.3 + patches)
            + wake_contact(i, p, foam.w, patches, fp);
    }
    return min(sum, WAKE_CAP);
}
