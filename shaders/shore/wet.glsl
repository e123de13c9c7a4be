// How wet the ground is: x how dark, y how much of it mirrors. The last swash wetted it, and since then it dries: the film in seconds,
// the sand in a minute; sand near the water's level stays soaked. docs/formulae.md, section 8.
uniform vec2 u_land_dries; // periods in which film and sand dry to 1/e

vec2 land_wet(vec2 q, float y) {
    vec2 still = vec2(shore_wet(y), 1.0 - smoothstep(0.1 * u_shore_swash, 0.6 * u_shore_swash + 0.03, y));
    if (y > 1.3 * u_shore_swash + 0.2) {
        return still;
    }
    ShoreField f = shore_field(q);
    // How high the ground is, in heights of the wave that ran up it, and how long ago its crest came by.
    float reach = y / max(f.here.g, 1e-3);
    vec2 left = (1.0 - smoothstep(0.8, 1.05, reach)) * exp((shore_turn(f.here.r) - 1.0) / u_land_dries);
    return max(still, vec2(left.y, left.x));
}
