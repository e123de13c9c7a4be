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

// high: whether the height at birth is asked for, which costs most.
bool open_born(int i, bool high, out Drop drop) {
    int batch = i % SPRAY_BATCHES;
    int level = i / SPRAY_BATCHES % SPRAY_LEVELS;
    int rest = i / (SPRAY_BATCHES * SPRAY_LEVELS);
    ivec2 cell = ivec2(rest % SPRAY_CELLS, rest / SPRAY_CELLS % SPRAY_CELLS);
    float side = u_spray_cell[level];
    vec2 eye = u_spray_eye[level];
    cell += ivec2(floor(eye + 0.35 * float(SPRAY_CELLS) * u_ray_z.xz - 0.5 * float(SPRAY_CELLS) + 0.5));
    drop.age = u_spray_time[0] + float(batch) * u_spray_step;
    int epoch = int(floor((u_spray_time[1] - u_spray_time[0]) / u_spray_step + 0.5)) - batch;
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
    drop.birth = vec3(at.x, high ? spray_height(at, batch, drop.age) : 0.0, at.y);
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
