// Foam on the front, and what is left of it, as in surf_front.glsl, over the turns of the wave that are under the footprint.
vec2 surf_front(float turn, vec2 out_to_sea, Footprint fp) {
    // From half a turn on all of it is there.
    float spread = min(torn_variance(out_to_sea, 1.0, fp), 0.04);
    // The front stands astride the end of the turn.
    float front = torn_step(0.8, 1.0, turn, spread) - torn_step(1.01, 1.09, turn, spread)
        + torn_step(0.8, 1.0, turn + 1.0, spread) - torn_step(1.01, 1.09, turn + 1.0, spread);
    float age = mix(exp((turn - 1.0) / u_surf_life), u_surf_life * (1.0 - exp(-1.0 / u_surf_life)), smoothstep(0.0, 0.04, spread));
    return vec2(front, age);
}
