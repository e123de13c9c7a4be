// Where and when drops are thrown: crests, surf, bursts, rocks, bows.

// @part open
// Water thrown up by waves in the open. Drops are born in batches: all of a batch at one moment, for which the sea is drawn once
// more. Each has a cell of one of several grids ahead of the eye, coarser with distance, looks at places in it, and starts from the one
// where the water breaks most, if it does.
uniform float u_spray_time[2];       // t modulo the time from batch to batch, and modulo 65536 batches, s
uniform float u_spray_step;          // from batch to batch, s
uniform float u_spray_cell[SPRAY_LEVELS]; // side of a grid's cells, m
uniform vec2 u_spray_eye[SPRAY_LEVELS];   // the eye's place in them, cells
uniform float u_spray_reach;         // m
uniform vec2 u_spray_crest_way;       // the same as a unit vector
uniform float u_spray_torn;          // share that is spindrift

// Share of a place's drops that a grid has: grids take over from each other with distance. middle: m.
float spray_share(float far, float middle, bool nearest) {
    float steps = log2(max(far, 0.01) / middle);
    return nearest && steps < 0.0 ? 1.0 : max(1.0 - abs(steps), 0.0);
}

bool open_born(int i, out Drop drop) {
    int batch = i % SPRAY_BATCHES;
    int level = i / SPRAY_BATCHES % SPRAY_LEVELS;
    int rest = i / (SPRAY_BATCHES * SPRAY_LEVELS);
    ivec2 cell = ivec2(rest % SPRAY_CELLS, rest / SPRAY_CELLS % SPRAY_CELLS);
    float side = u_spray_cell[level];
    vec2 eye = u_spray_eye[level];
    cell += as_int(floor(eye + 0.35 * float(SPRAY_CELLS) * u_ray_z.xz - 0.5 * float(SPRAY_CELLS) + 0.5));
    drop.age = u_spray_time[0] + float(batch) * u_spray_step;
    int epoch = as_int(floor((u_spray_time[1] - u_spray_time[0]) / u_spray_step + 0.5)) - batch;
    int member = rest / (SPRAY_CELLS * SPRAY_CELLS);
    uint own = noise_hash(uint(member / SPRAY_CLUSTER * SPRAY_LEVELS + level));
    uint cluster = noise_hash(noise_hash(noise_hash(own ^ uint(cell.x & 255)) ^ uint(cell.y & 255)) ^ uint(epoch & 65535));
    drop.word = noise_hash(cluster ^ uint(member % SPRAY_CLUSTER));
    // The cluster's place; each of its drops starts beside it, where the water breaks too.
    vec2 place = vec2(0.0);
    vec3 onward;
    float strong;
    float most = 0.0;
    for (uint k = 16u; k < 16u + 2u * uint(SPRAY_PLACES); k += 2u) {
        vec2 rests = (vec2(cell) + vec2(spray_part(cluster, k), spray_part(cluster, k + 1u)) - eye) * side;
        vec2 p = rests;
        float breaks = spray_breaks(p, batch, drop.age, onward, strong);
        if (breaks > most) {
            most = breaks;
            place = rests;
        }
    }
    if (most <= 0.0) {
        return false;
    }
    // Beside along the crest.
    vec2 way = u_spray_crest_way;
    vec2 beside = SPRAY_BESIDE * side * (vec2(spray_part(drop.word, 12u), spray_part(drop.word, 13u)) - 0.5) * vec2(0.25, 1.0);
    vec2 at = place + beside.x * way + beside.y * vec2(-way.y, way.x);
    most = spray_breaks(at, batch, drop.age, onward, strong);
    float share = spray_share(length(at), 0.5 * u_spray_reach * exp2(float(level - SPRAY_LEVELS + 1)), level == 0);
    drop.strength = smoothstep(0.25, 0.7, most) * share * strong;
    if (drop.strength <= 0.0) {
        return false;
    }
    drop.birth = vec3(at.x, spray_height(at, batch, drop.age), at.y);
    float torn = spray_part(drop.word, 5u);
    drop.kind = torn < u_spray_torn ? SPRAY_DRIFT : torn < u_spray_torn + (1.0 - u_spray_torn) * u_spray_mist ? SPRAY_MIST : SPRAY_SHEET;
    // A cluster flies together, and spreads.
    float aside = 0.3 * (spray_part(cluster, 2u) + spray_part(drop.word, 2u) - 1.0);
    float rise = u_spray_speed * onward.y * (drop.kind == SPRAY_DRIFT ? 0.4 : 1.0);
    drop.velocity = vec3(0.0, rise * (0.3 + 0.7 * spray_part(cluster, 1u)) * (0.3 + 0.7 * spray_part(drop.word, 1u)), 0.0);
    drop.velocity.xz = onward.xz * (0.8 + 0.2 * spray_part(cluster, 4u) + 0.2 * spray_part(drop.word, 4u)) + aside * vec2(-onward.z, onward.x);
    drop.radius = 1.4 * u_spray_size * SPRAY_WIDER * side * (0.4 + 0.6 * strong);
    drop.life = u_spray_step * float(SPRAY_BATCHES);
    return true;
}

// @part table
// The table of drops: three texels each, and two numbers that follow from them.
uniform sampler2DArray u_spray_births;
uniform float u_spray_drag; // s

// part 0: birth, age; 1: velocity, radius; 2: strength, kind, seed, life. A strength of 0: not in the air.
vec4 spray_entry(sampler2DArray table, int i, int part) {
    return texel_at(table, ivec3(i % SPRAY_COLUMNS, i / SPRAY_COLUMNS, part));
}

// Time constant of the air's drag (s) and fall without air (m/s2). Mist rides on the air that the burst has set in motion and hardly
// falls; the wind tears spindrift along at once; the water of a column is too much for the air.
vec2 spray_fall(float kind, float vary) {
    float tau = u_spray_drag * (0.6 + 0.8 * vary);
    return kind == SPRAY_SHEET ? vec2(tau, 9.81)
        : kind == SPRAY_MIST ? vec2(tau, 1.5)
        : kind == SPRAY_DRIFT ? vec2(0.5 * tau, 2.5)
        : vec2(4.0 * tau, 9.81);
}

// How long after its birth a drop is not seen, s: batches would come in beats.
float spray_delay(float kind, float share) {
    return SPRAY_BEAT * share * (kind == SPRAY_SHEET ? 0.35 : kind == SPRAY_COLUMN ? 0.0 : 0.9);
}

// How long of its age spindrift has gone on with the crest that tears it off later, s.
float spray_rides(float kind, uint word, float age) {
    return kind == SPRAY_DRIFT ? min(spray_delay(kind, spray_part(word, 8u)), age) : 0.0;
}

// @part thrown
// What all births of drops depend on.
uniform float u_spray_speed;
uniform float u_spray_size; // m
uniform float u_spray_mist; // share that is mist
uniform float u_spray_threshold; // m/s

// How hard a front breaks that rises as fast (m/s).
float front_breaks(float rise) {
    return 2.0 * (rise / max(u_spray_threshold, 0.1) - 1.0);
}

// @part breaking
// Where the open water breaks: folds of the sea, and fronts of single waves that rise fast.
uniform vec2 u_spray_crest;    // velocity of the sea's breaking crests, m/s
uniform float u_spray_strong;  // strength of what they throw, 0 to 1

// How hard, above 0 where it does; p: where the water rests, and returns where it is. onward: velocity of the front that throws the
// water, y: its rise, m/s; strong: of what it throws.
float spray_breaks(inout vec2 p, int batch, float age, out vec3 onward, out float strong) {
    float folds = sea_breaks(p, batch);
    vec4 fronts = fronts_then(p, age);
    float steep = front_breaks(fronts.w);
    strong = u_spray_strong;
    onward = vec3(u_spray_crest, strong * (0.2 + 0.3 * clamp(folds, 0.0, 1.0)) * length(u_spray_crest)).xzy;
    if (steep > folds) {
        // Level lines of the wave go on at rise over slope; a crest has none, and is held.
        strong = 1.0;
        onward = vec3(-fronts.yz * (fronts.w / max(dot(fronts.yz, fronts.yz), 0.02)), fronts.w).xzy;
    }
    return max(folds, steep);
}

// Height of the surface, m.
float spray_height(vec2 p, int batch, float age) {
    return sea_then(p, batch) + fronts_then(p, age).x + rings_then(p, age);
}

// @part breaking_surf
// Where surf breaks on a beach: fronts of the shore's waves that rise fast.

// How hard, above 0 where it does. onward: velocity of the front that throws the water, y: its rise, m/s; strong: of what it throws.
float spray_breaks(inout vec2 p, int batch, float age, out vec3 onward, out float strong) {
    strong = 1.0;
    onward = vec3(0.0);
    vec2 q = shore_place(p);
    if (any(greaterThan(abs(q), vec2(0.5 * u_shore_size)))) {
        return 0.0;
    }
    ShoreField f = shore_field(q);
    if (f.here.g <= 0.0) {
        return 0.0;
    }
    float rise = (shore_then(f, q, age - SPRAY_MOMENT) - shore_then(f, q, age + SPRAY_MOMENT)) / (2.0 * SPRAY_MOMENT);
    // The phase grows out to sea, by a period in the time that a wave takes.
    vec2 out_to_sea = vec2(f.along_x.r, f.along_z.r);
    onward = vec3(-out_to_sea / (max(dot(out_to_sea, out_to_sea), 1e-4) * u_spray_period), rise).xzy;
    return front_breaks(rise);
}

// Height of the surface, m.
float spray_height(vec2 p, int batch, float age) {
    vec2 q = shore_place(p);
    ShoreField f = shore_field(q);
    return f.here.a * (sea_then(p, batch) + fronts_then(p, age).x + rings_then(p, age)) + shore_then(f, q, age);
}

// @part bursts
// Water thrown up by blasts under it: a column of jets, a crown about its foot, and the surge of mist that spreads when it falls back.
uniform vec4 u_spray_burst[SPRAY_BURSTS];      // from its middle to the eye x, z (m), age (s), height of the column (m)
uniform float u_spray_burst_wide[SPRAY_BURSTS]; // radius of the column's foot, m

bool burst_born(int i, out Drop drop) {
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

// @part rocks
// Water thrown up where surf breaks on rocks: each drop has its place on a rock, and starts when a crest gets there.
uniform sampler2D u_spray_rocks;  // place in the shore's square (m), way out to sea
uniform float u_spray_surf_time[2]; // t modulo a period of the surf, and modulo 65536 periods, s
uniform float u_spray_surf_life;  // s

bool rock_born(int i, out Drop drop) {
    uint own = noise_hash(uint(i));
    vec4 rock = texel_at(u_spray_rocks, ivec2(i % SPRAY_ROCKS, 0));
    vec2 along = vec2(-rock.w, rock.z);
    vec2 q = rock.xy + 2.0 * (spray_part(own, 0u) - 0.5) * along;
    ShoreField f = shore_field(q);
    // Crests are where the turn is a whole number; it falls as time goes on.
    float turn = -u_spray_surf_time[0] / u_spray_period - f.here.r;
    int wave = as_int(floor(turn)) - as_int(floor((u_spray_surf_time[1] - u_spray_surf_time[0]) / u_spray_period + 0.5));
    drop.word = noise_hash(own ^ uint(wave & 65535));
    // Waves do not break alike along a coast: patches of six metres, each wave anew, each burst a little after the crest.
    ivec2 spot = as_int(floor(q / 6.0));
    uint burst = noise_hash(noise_hash(noise_hash(uint(spot.x)) ^ uint(spot.y)) ^ uint(wave & 65535));
    drop.age = (1.0 - (turn - floor(turn))) * u_spray_period - SPRAY_DELAY * (0.7 * spray_part(burst, 0u) + 0.3 * spray_part(drop.word, 1u));
    float strong = 0.3 + 0.7 * spray_part(burst, 1u);
    float start = u_spray_speed * sqrt(9.81 * max(f.here.g / 0.3, 0.0)) * strong;
    vec2 p = q - shore_place(vec2(0.0));
    float height = shore_then(f, q, drop.age) + f.here.a * (fronts_then(p, drop.age).x + rings_then(p, drop.age));
    drop.birth = vec3(p.x, height, p.y);
    // Jets, a metre and a half of rock each, lean out to sea and aside; their drops fan out about them.
    ivec2 jet = as_int(floor(q / 1.5));
    uint way = noise_hash(noise_hash(noise_hash(uint(jet.x)) ^ uint(jet.y)) ^ uint(wave & 65535));
    float fast = start * (0.4 + 0.6 * spray_part(way, 0u)) * (0.25 + 0.75 * spray_part(drop.word, 2u));
    float lean = 0.3 * spray_part(way, 1u) + 0.2 * spray_part(drop.word, 4u) - 0.05;
    float aside = 0.7 * spray_part(way, 2u) + 0.3 * spray_part(drop.word, 7u) - 0.5;
    drop.velocity = vec3(0.0, fast * (0.8 + 0.2 * spray_part(drop.word, 3u)), 0.0);
    drop.velocity.xz = fast * (lean * rock.zw + aside * along);
    drop.kind = spray_part(drop.word, 5u) < u_spray_mist ? SPRAY_MIST : SPRAY_SHEET;
    // Mist is a veil: puffs that are dense and small stand before the rock as smears. What tears into strings is narrow.
    bool veil = drop.kind == SPRAY_MIST;
    drop.radius = (veil ? 5.3 : 3.2) * u_spray_size * SPRAY_WIDER;
    drop.life = u_spray_surf_life;
    drop.strength = veil ? 0.15 : 0.8;
    return drop.age >= 0.0 && drop.age < drop.life && start > u_spray_threshold;
}

// @part fronts
// Single waves of an earlier time: theirs of now, with their phases turned back.
uniform float u_parametric_rate[PARAMETRIC_COUNT]; // rad/s

// Height, gradient and rise (m/s) of the waves at a place, age seconds ago.
vec4 fronts_then(vec2 p, float age) {
    vec4 sum = vec4(-u_parametric_level, 0.0, 0.0, 0.0);
    for (int i = 0; i < PARAMETRIC_COUNT; ++i) {
        vec4 wave = u_parametric[i];
        vec2 of_half = parametric_half(u_parametric_phase[i] - dot(wave.xy, p) - u_parametric_rate[i] * age);
        vec2 profile = wave.z * parametric_profile(of_half, wave.w, parametric_kind(i));
        sum += vec4(profile.x, -profile.y * wave.xy, profile.y * u_parametric_rate[i]);
    }
    return sum;
}

// @part fronts_none
// No single waves.
vec4 fronts_then(vec2 p, float age) {
    return vec4(0.0);
}

// @part rings_then
// Height of the rings, age seconds ago, m.
uniform vec4 u_spray_ring_now[RING_COUNT];   // from the centre to the eye x, z (m), age (s), what lies behind the front (m)
uniform vec4 u_spray_ring_shape[RING_COUNT]; // I0 (m), k (rad/m), omega (rad/s), b (1/s)

float rings_then(vec2 p, float age) {
    float sum = 0.0;
    for (int i = 0; i < RING_COUNT; ++i) {
        vec4 then = u_spray_ring_now[i] - vec4(0.0, 0.0, age, 0.0);
        vec2 way = p + then.xy;
        if (then.z > 0.0) {
            sum += ring_profile(way, then, u_spray_ring_shape[i]).x;
        }
    }
    return sum;
}

// @part shore_then
// The shore's waves of an earlier time: theirs of now, with their phase turned back and the height that the mask gave them then.
uniform float u_spray_period;     // of the surf, s
uniform float u_spray_variation;  // of its height
uniform vec2 u_spray_mask[4];     // wavevectors of the mask, rad/m
uniform float u_spray_mask_phase[4];
uniform float u_spray_mask_rate[4]; // rad/s

// What the mask leaves of the height at a place of the square, age seconds ago.
float shore_rhythm(vec2 q, float age) {
    float sum = 0.0;
    for (int i = 0; i < 4; ++i) {
        sum += sin(wrap_phase(u_spray_mask_phase[i] + dot(u_spray_mask[i], q) - u_spray_mask_rate[i] * age));
    }
    return 1.0 - u_spray_variation * smoothstep(-0.8, 0.8, 0.5 * sum);
}

// Height of the shore's waves where its map says f, age seconds ago, m.
float shore_then(ShoreField f, vec2 q, float age) {
    float turn = fract(shore_turn(f.here.r) + age / u_spray_period);
    float height = f.here.g * shore_rhythm(q, age) / max(shore_rhythm(q, 0.0), 1e-3);
    return max(height, 0.0) * shore_profile(turn, f.here.b).x;
}

// @part pass
// The table of drops at their births.
layout(location = 0) out vec4 o_birth;
layout(location = 1) out vec4 o_velocity;
layout(location = 2) out vec4 o_traits;

void main() {
    ivec2 at = as_int(floor(gl_FragCoord.xy));
    Drop drop;
    o_birth = o_velocity = o_traits = vec4(0.0);
    if (spray_born(at.y * SPRAY_COLUMNS + at.x, drop)) {
        o_birth = vec4(drop.birth, drop.age);
        o_velocity = vec4(drop.velocity, drop.radius);
        o_traits = vec4(SPRAY_THINNER * drop.strength, drop.kind, float(drop.word >> 8u), drop.life);
    }
}
