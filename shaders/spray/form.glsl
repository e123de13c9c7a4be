// How a drop's water spreads and tears as it flies. docs/formulae.md, section 13.
// radius: in those of its birth; moment: how long a streak its flight leaves, s; longest: that streak at most, in radii; depth: optical
// depth of its middle; cover: share that is covered there; soft: of the strands' edges.
struct SprayForm {
    float radius;
    float moment;
    float longest;
    float depth;
    float cover;
    float soft;
};

SprayForm spray_form(float kind, float age, float life, float vary, float other) {
    float x = max(age, 0.0) / life;
    float ends = 1.0 - smoothstep(0.55, 1.0, x);
    float begins = smoothstep(0.0, 0.06, x);
    if (kind == SPRAY_MIST) {
        float grown = (0.5 + 0.5 * vary) * (1.0 + 2.2 * x);
        return SprayForm(grown, 0.2, 1.5, 0.9 * ends * begins / (0.4 + grown * grown), 0.85, 0.7);
    }
    if (kind == SPRAY_DRIFT) {
        float grown = (0.3 + 0.4 * vary) * (1.0 + 3.0 * x);
        return SprayForm(grown, 0.5, 6.0, 0.6 * (1.0 - x) * ends * begins / (0.3 + grown), 0.75, 0.5);
    }
    if (kind == SPRAY_COLUMN) {
        float grown = (0.6 + 0.8 * vary) * (1.0 + 1.6 * x);
        return SprayForm(grown, 0.15, 3.0, 1.8 * ends * smoothstep(0.0, 0.02, x) / (0.4 + 0.6 * grown), mix(1.1, 0.3, smoothstep(0.05, 0.8, x)), 0.3);
    }
    // Sheet, ligaments, drops.
    float grown = (0.35 + 0.9 * vary * vary) * (1.0 + 1.4 * x);
    return SprayForm(grown, 0.15, 2.5, 1.2 * ends * begins, mix(0.8, 0.18, smoothstep(0.0, 0.6, x)) * (0.6 + 0.4 * other), 0.22);
}
