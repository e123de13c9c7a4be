// Water thrown up by blasts under it: a column of jets, a crown about its foot, and the surge of mist that spreads when it falls back.
uniform vec4 u_spray_burst[SPRAY_BURSTS];      // from its middle to the eye x, z (m), age (s), height of the column (m)
uniform float u_spray_burst_wide[SPRAY_BURSTS]; // radius of the column's foot, m

bool burst_born(int i, bool high, out Drop drop) {
    vec4 burst = u_spray_burst[i % SPRAY_BURSTS];
    float wide = u_spray_burst_wide[i % SPRAY_BURSTS];
    drop.word = noise_hash(noise_hash(uint(i)));
    float fastest = sqrt(2.4 * 9.81 * burst.w);
    float part = spray_part(drop.word, 0u);
    // Jets, each with its own way and speed; what is slower in one follows below.
    uint jet = noise_hash(uint(spray_part(drop.word, 1u) * 48.0) ^ uint(i % SPRAY_BURSTS) << 8u);
    float turn = TAU * spray_part(jet, 0u);
    vec2 way = vec2(cos(turn), sin(turn));
    float about = TAU * spray_part(drop.word, 2u);
    vec2 place = sqrt(spray_part(drop.word, 3u)) * vec2(cos(about), sin(about));
    float share = spray_part(drop.word, 4u);
    drop.strength = 1.0;
    drop.kind = SPRAY_COLUMN;
    float level;
    if (part < 0.62) {
        float tilt = spray_part(jet, 1u);
        place = sqrt(tilt) * way + 0.25 * place;
        float fast = fastest * (1.0 - 0.45 * tilt) * (0.6 + 0.4 * spray_part(jet, 2u)) * sqrt(0.02 + 0.98 * share);
        drop.velocity = vec3(0.0, fast, 0.0);
        drop.velocity.xz = fast * ((0.04 + 0.3 * tilt * tilt * spray_part(jet, 3u)) * way + 0.04 * place);
        drop.age = burst.z - 0.5 * tilt * spray_part(drop.word, 7u);
        drop.radius = burst.w * (0.02 + 0.035 * (1.0 - share));
        drop.strength = 0.35;
        level = 0.8;
    } else if (part < 0.76) {
        place = normalize(place + vec2(1e-4, 0.0));
        drop.velocity = vec3(0.0, fastest * (0.2 + 0.2 * share), 0.0);
        drop.velocity.xz = fastest * (0.1 + 0.22 * share * spray_part(jet, 3u)) * place;
        drop.age = burst.z - 0.2 * spray_part(drop.word, 7u);
        drop.radius = 0.025 * burst.w;
        drop.strength = 0.3;
        level = 1.0;
    } else {
        // The surge: from where the falling column meets the water.
        place = normalize(place + vec2(1e-4, 0.0));
        drop.kind = SPRAY_MIST;
        drop.velocity = vec3(0.0, 0.1 * fastest * (0.3 + share), 0.0);
        drop.velocity.xz = fastest * (0.25 + 0.35 * share) * place;
        drop.age = burst.z - 0.09 * fastest - 0.07 * fastest * spray_part(drop.word, 7u);
        drop.radius = 0.025 * burst.w;
        drop.strength = 0.22;
        level = 1.0;
    }
    drop.radius *= SPRAY_WIDER * u_spray_size * 25.0;
    drop.birth = vec3(wide * level * place - burst.xy, -0.3).xzy;
    drop.life = 0.25 * fastest + 2.0;
    return drop.age >= 0.0 && drop.age < drop.life;
}
