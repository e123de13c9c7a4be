// Foam of the surf: thick on the breaking front, dying away in patches behind it, a veil between. It is carried to and fro
// with the water along the gradient of the distance to shore, and on the beach it drains.
uniform float u_surf_foam; // saturation on the front
uniform float u_surf_veil;

// Of the place asked for last: to and fro with the water, m, and the open sea's share of its waves.
vec3 surf_carried;

float surf_saturation(vec2 p, float height, Footprint fp) {
    vec2 q = shore_place(p);
    ShoreField f = shore_field(q);
    // Behind the crest the turn falls from 1: 1 - turn periods ago it broke here.
    float turn = shore_turn(f.here.r);
    float front = max(1.0 - smoothstep(0.01, 0.09, turn), smoothstep(0.8, 1.0, turn));
    float age = exp((turn - 1.0) / u_surf_life);
    float breaking = smoothstep(0.45, 0.9, f.here.b) * smoothstep(0.12, 0.4, f.here.g * u_surf_scale);
    vec2 out_to_sea = vec2(f.along_x.r, f.along_z.r);
    surf_carried = vec3(1.5 * f.here.g * sin(TAU * turn) / max(length(out_to_sea), 1e-6) * out_to_sea, f.here.a);
    vec2 carried = q + surf_carried.xy;
    float patches = surf_patches(carried);
    // The last of the water runs off under its foam: what is thinner than a hand holds more of it.
    float film = 1.0 - smoothstep(0.0, 0.15, height - shore_floor(q).x);
    float left = u_surf_foam * max(front * (0.65 + 0.55 * patches), age * (0.3 + 0.9 * patches)) * (1.0 + film);
    return min(breaking * (left + 2.0 * u_surf_veil * patches), SURF_CAP);
}
