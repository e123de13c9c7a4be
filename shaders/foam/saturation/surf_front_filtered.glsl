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

// Where the water ends within the footprint its foam goes over into that on the ground: no edge jumps from one sample to the next.
// whole: its foam; ground: height and gradient of the ground.
float surf_at_edge(ShoreField f, vec4 ground, float height, float whole, float patches, Footprint fp) {
    vec2 fall = shore_tilt - ground.yz;
    float reach = clamp(abs(dot(fall, fp.x)) + abs(dot(fall, fp.y)), 1e-3, 0.15);
    return mix(surf_swept(f, ground.x, patches, fp), whole, clamp(2.0 * (height - ground.x) / reach, 0.0, 1.0));
}
