// Foam of surf: its front, what it has swept, its patches; and around stones.

// @part surf
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

// @part front
// Foam on the front, and what is left of it. turn: that of the wave, [0, 1]: behind the crest it falls from 1, 1 - turn periods ago it
// broke here.
vec2 surf_front(float turn, vec2 out_to_sea, Footprint fp) {
    return vec2(max(1.0 - smoothstep(0.01, 0.09, turn), smoothstep(0.8, 1.0, turn)), exp((turn - 1.0) / u_surf_life));
}

float surf_at_edge(ShoreField f, vec4 ground, float height, float whole, float patches, Footprint fp) {
    return whole;
}

// @part front_filtered
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

// @part patches
// Patches that foam of the surf tears into, [0, 1]. q: where its water lies, from the middle of the square, m.
uniform float u_surf_life;  // time to 1/e, periods
uniform float u_surf_scale; // 1 / height of a breaking wave, 1/m

float surf_patches(vec2 q, Footprint fp) {
    vec2 turned = vec2(0.8 * q.x - 0.6 * q.y, 0.6 * q.x + 0.8 * q.y);
    vec2 torn = torn_noise(TORN_NONE, 0.4, 6.0, noise_value(NOISE_KEY, turned / 6.0), fp);
    torn = torn_noise(torn, 0.35, 1.7, noise_value(NOISE_KEY, q / 1.7), fp);
    torn = torn_noise(torn, 0.25, 0.5, noise_value(NOISE_KEY, turned / 0.5), fp);
    return torn_step(0.25, 0.72, torn.x, torn.y);
}

// @part swept
// Foam that the swash leaves on the sand: on all that it swept, thinning as on the water, and a line where it turned, which lasts longer.
// docs/formulae.md, section 8.
uniform float u_surf_line;

// What is left of both after -since periods.
float swept_left(vec2 born, float since) {
    return min(dot(born, exp(since / (vec2(1.0, 3.0) * u_surf_life))), SURF_CAP);
}

float surf_swept(ShoreField f, float ground, float patches, Footprint fp) {
    if (!SURF_LINED) {
        return 0.0;
    }
    // How high the ground is, in heights of the wave that runs up it.
    float reach = ground / max(f.here.g, 1e-3);
    if (reach >= 1.05) {
        return 0.0;
    }
    float since = shore_turn(f.here.r) - 1.0;
    float swept = 1.0 - smoothstep(0.85, 1.0, reach);
    float line = smoothstep(0.55, 0.9, reach) * (1.0 - smoothstep(0.95, 1.05, reach));
    float ran_up = smoothstep(0.02, 0.1, f.here.g * u_surf_scale);
    vec2 born = u_surf_line * ran_up * (0.3 + 0.9 * patches) * vec2(swept, line);
    float left = swept_left(born, since);
    if (!SURF_FILTERED) {
        return left;
    }
    // Where a wave's end goes through the footprint, some of it was swept a moment ago and some a period ago.
    vec2 out_to_sea = vec2(f.along_x.r, f.along_z.r);
    float width = clamp(abs(dot(out_to_sea, fp.x)) + abs(dot(out_to_sea, fp.y)), 1e-5, 1.0);
    bool late = since < -0.5;
    float share = max(0.5 - (late ? since + 1.0 : -since) / width, 0.0);
    return mix(left, swept_left(born, late ? 0.0 : -1.0), share);
}

// @part stones
// Foam of stones in a current: a cushion on the upstream face, and white water that the current carries away. f in [0, WAKE_CAP].
uniform vec4 u_stone_foam[STONE_COUNT]; // amount, way to 1/e (m), amount of the cushion, 0

float stones_saturation(vec2 p, float height, Footprint fp) {
    float sum = 0.0;
    for (int i = 0; i < STONE_COUNT; ++i) {
        vec4 foam = u_stone_foam[i];
        float radius = u_stone_form[i].y;
        float size = 4.0 * radius;
        StoneWay way = stone_way(i, p);
        float x = way.behind / radius - 1.0;
        float z = way.aside / radius;
        vec2 on = (p + u_stone_course[i].xy) / size;
        vec2 turned = vec2(0.8 * on.x - 0.6 * on.y, 0.6 * on.x + 0.8 * on.y);
        vec2 torn = torn_noise(TORN_NONE, 0.4, 0.31 * size, noise_value(NOISE_KEY, on / 0.31), fp);
        torn = torn_noise(torn, 0.35, 0.11 * size, noise_value(NOISE_KEY, turned / 0.11), fp);
        torn = torn_noise(torn, 0.25, 0.037 * size, noise_value(NOISE_KEY, on / 0.037), fp);
        float patches = torn_step(0.25, 0.72, torn.x, torn.y);
        float along = torn_variance(way.on_behind, radius, fp);
        float across = torn_variance(way.on_aside, radius, fp);
        float width = 0.9 + 0.2 * sqrt(max(x, 0.0));
        float band = torn_step(-1.2 * width, -0.6 * width, z, across) - torn_step(0.6 * width, 1.2 * width, z, across);
        band *= torn_step(-0.7, 0.3, x, along) * exp(-min(max(x, 0.0) * radius / foam.y, 80.0));
        // A bell about the rim, wider over a footprint.
        float off = length(vec2(x, z)) - 1.0;
        float wider = 1.0 + 2.0 * (along + across) / 0.0625;
        float rim = exp(-min(off * off / (0.0625 * wider), 80.0)) * inversesqrt(wider);
        float cushion = rim * (1.0 - torn_step(-0.5, 0.5, x, along));
        sum += foam.x * band * (0.3 + 0.9 * patches) + foam.z * cushion * (0.3 + patches);
    }
    return min(sum, WAKE_CAP);
}
