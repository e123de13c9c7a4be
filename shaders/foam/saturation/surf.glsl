// Foam of the surf: thick on the breaking front, dying away in patches behind it, a veil between. It is carried to and fro
// with the water along the gradient of the distance to shore, and on the beach it drains.
uniform float u_surf_foam; // saturation on the front
uniform float u_surf_veil;

// Of the place asked for last: to and fro with the water, m, and the open sea's share of its waves.
vec3 surf_carried;

float surf_saturation(vec2 p, float height, Footprint fp) {
    vec2 q = shore_place(p);
    ShoreField f = shore_field(q);
    float turn = shore_turn(f.here.r);
    float breaking = smoothstep(0.45, 0.9, f.here.b) * smoothstep(0.12, 0.4, f.here.g * u_surf_scale);
    vec2 out_to_sea = vec2(f.along_x.r, f.along_z.r);
    surf_carried = vec3(shore_carried(f, turn), f.here.a);
    vec2 front = surf_front(turn, out_to_sea, fp);
    float patches = surf_patches(q + surf_carried.xy, fp);
    // The last of the water runs off under its foam: what is thinner than a hand holds more of it.
    vec4 ground = shore_floor(q);
    float film = 1.0 - smoothstep(0.0, 0.15, height - ground.x);
    float left = u_surf_foam * max(front.x * (0.65 + 0.55 * patches), front.y * (0.3 + 0.9 * patches)) * (1.0 + film);
    float whole = min(breaking * (left + 2.0 * u_surf_veil * patches), SURF_CAP);
    return surf_at_edge(f, ground, height, whole, patches, fp);
}
