// Foam of the surf as in surf.glsl, averaged over the footprint: its patches, the front over the turns of the wave under it, and the water's edge.
uniform float u_surf_foam; // saturation on the front
uniform float u_surf_veil;

// Of the place asked for last: to and fro with the water, m, and the open sea's share of its waves.
vec3 surf_carried;

float surf_saturation(vec2 p, float height, Footprint fp) {
    vec2 q = shore_place(p);
    ShoreField f = shore_field(q);
    float turn = shore_turn(f.here.r);
    vec2 out_to_sea = vec2(f.along_x.r, f.along_z.r);
    // Variance of the turn under the footprint; from half a turn on all of it is there.
    vec2 turns = vec2(dot(out_to_sea, fp.x), dot(out_to_sea, fp.y));
    float spread = min(dot(turns, turns) / 12.0, 0.04);
    // The front stands astride the end of the turn.
    float front = torn_step(0.8, 1.0, turn, spread) - torn_step(1.01, 1.09, turn, spread)
        + torn_step(0.8, 1.0, turn + 1.0, spread) - torn_step(1.01, 1.09, turn + 1.0, spread);
    float age = mix(exp((turn - 1.0) / u_surf_life), u_surf_life * (1.0 - exp(-1.0 / u_surf_life)), smoothstep(0.0, 0.04, spread));
    float breaking = smoothstep(0.45, 0.9, f.here.b) * smoothstep(0.12, 0.4, f.here.g * u_surf_scale);
    surf_carried = vec3(1.5 * f.here.g * sin(TAU * turn) / max(length(out_to_sea), 1e-6) * out_to_sea, f.here.a);
    vec2 carried = q + surf_carried.xy;
    vec2 turned = vec2(0.8 * carried.x - 0.6 * carried.y, 0.6 * carried.x + 0.8 * carried.y);
    vec2 torn = torn_noise(vec2(0.5, 0.0), 0.4, 6.0, noise_value(NOISE_KEY, turned / 6.0), fp);
    torn = torn_noise(torn, 0.35, 1.7, noise_value(NOISE_KEY, carried / 1.7), fp);
    torn = torn_noise(torn, 0.25, 0.5, noise_value(NOISE_KEY, turned / 0.5), fp);
    float patches = torn_step(0.25, 0.72, torn.x, torn.y);
    vec4 ground = shore_floor(q);
    float depth = height - ground.x;
    float film = 1.0 - smoothstep(0.0, 0.15, depth);
    float left = u_surf_foam * max(front * (0.65 + 0.55 * patches), age * (0.3 + 0.9 * patches)) * (1.0 + film);
    // Where the water ends within the footprint its foam goes over into that on the ground: no edge jumps from one sample to the next.
    vec2 fall = shore_tilt - ground.yz;
    float reach = clamp(abs(dot(fall, fp.x)) + abs(dot(fall, fp.y)), 1e-3, 0.15);
    float whole = min(breaking * (left + 2.0 * u_surf_veil * patches), SURF_CAP);
    return mix(surf_swept(f, ground.x, patches, fp), whole, clamp(2.0 * depth / reach, 0.0, 1.0));
}
