// Foam of the surf: thick on the breaking front, dying away behind it, a veil between; on the beach it drains with the water.
uniform float u_surf_foam; // saturation on the front
uniform float u_surf_life; // time to 1/e, periods
uniform float u_surf_veil;
uniform float u_surf_scale; // 1 / height of a breaking wave, 1/m

float surf_saturation(vec2 p, float height, Footprint fp) {
    vec2 q = shore_place(p);
    ShoreField f = shore_field(q);
    // Behind the crest the turn falls from 1: 1 - turn periods ago it broke here.
    float turn = shore_turn(f.here.r);
    float front = 1.0 - smoothstep(0.03, 0.16, turn);
    float age = exp((turn - 1.0) / u_surf_life);
    float breaking = smoothstep(0.45, 0.9, f.here.b) * smoothstep(0.12, 0.4, f.here.g * u_surf_scale);
    // The last of the water runs off under its foam: what is thinner than a hand holds more of it.
    float film = 1.0 - smoothstep(0.0, 0.15, height - shore_floor(q).x);
    return min(breaking * (u_surf_foam * max(front, age) * (1.0 + film) + u_surf_veil), 4.0);
}
