// Longest step after which a ray cannot have passed the surface: it is `gap` (m, at least 0) away, the gap changes by `rate` a unit of
// the ray, closes by `fastest` at most, and its second derivative is at least -curvature: gap - grain + rate t - curvature t^2 / 2 >= 0.
// grain: what reading the surface from maps may add to that, m. docs/formulae.md, section 3.
float safe_step(float gap, float grain, float rate, float fastest, float curvature) {
    float sure = max(gap - grain, 0.0);
    float root = sqrt(rate * rate + 2.0 * curvature * sure);
    // Of the two forms of the root the one that does not cancel.
    float curved = rate < 0.0 ? 2.0 * sure / max(root - rate, 1e-20) : (sure > 0.0 ? (root + rate) / max(curvature, 1e-9) : 0.0);
    return max(gap / fastest, curved);
}
