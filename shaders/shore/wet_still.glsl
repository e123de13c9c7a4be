// How wet the ground is: x how dark, y how much of it mirrors. By its height alone.
vec2 land_wet(vec2 q, float y) {
    return vec2(1.0, 0.6) * shore_wet(y);
}
