// Foam on the front, and what is left of it. turn: that of the wave, [0, 1]: behind the crest it falls from 1, 1 - turn periods ago it
// broke here.
vec2 surf_front(float turn, vec2 out_to_sea, Footprint fp) {
    return vec2(max(1.0 - smoothstep(0.01, 0.09, turn), smoothstep(0.8, 1.0, turn)), exp((turn - 1.0) / u_surf_life));
}

float surf_at_edge(ShoreField f, vec4 ground, float height, float whole, float patches, Footprint fp) {
    return whole;
}
