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
