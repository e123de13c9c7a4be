// Foam's mask carried by the flow: clocks, patches, and how they are blended.

// @part clock
// The four generations of patches that are alive: a new one every DRIFT_GENERATION seconds, each four times as long alive.
uniform vec2 u_drift_clock; // t modulo 1024 generations and modulo one, s: reduced in float64

float drift_age(int j) {
    return u_drift_clock.y + float(j) * DRIFT_GENERATION;
}

// The generation's number modulo 1024: the difference is a whole number of generations.
uint drift_generation(int j) {
    return uint(as_int(floor((u_drift_clock.x - u_drift_clock.y) / DRIFT_GENERATION + 0.5)) - j + 1024) & 1023u;
}

// How much of each generation there is: sin^2 over its life, 2 together at any time; what is older than the window is gone.
vec4 drift_shares() {
    vec4 age = u_drift_clock.y + vec4(0.0, 1.0, 2.0, 3.0) * DRIFT_GENERATION;
    vec4 s = sin(0.25 * PI / DRIFT_GENERATION * age);
    vec4 shares = s * s;
    return DRIFT_CUT ? shares * (1.0 - smoothstep(0.75 * DRIFT_WINDOW, DRIFT_WINDOW, age)) : shares;
}

// @part flow
// The flow that carries foam: a steady part, and vortices of Lamb (1932) and Oseen that end at six radii. q: m from the square's
// middle; m/s. Beyond the square the vortices are as at its rim. Exact to float32. docs/formulae.md, section 14.
uniform vec2 u_drift_steady;                   // current and waves' drift, m/s
uniform vec4 u_drift_vortex[DRIFT_VORTICES];   // centre x, z (m), radius (m), angular velocity at the centre (rad/s)

vec2 drift_velocity(vec2 q) {
    vec2 held = clamp(q, -u_drift_half, u_drift_half);
    vec2 sum = u_drift_steady;
    for (int i = 0; i < DRIFT_VORTICES; ++i) {
        vec4 vortex = u_drift_vortex[i];
        vec2 way = held - vortex.xy;
        float square = dot(way, way) / (vortex.z * vortex.z);
        float y = 1.25643121 * square;
        // (1 - e^-y)/y loses its digits, and at the centre all of them: 0/0.
        float share = y < 0.05 ? 1.0 - y * (0.5 - y * (0.166666667 - y * 0.0416666667)) : (1.0 - exp(-min(y, 80.0))) / y;
        share *= 1.0 - smoothstep(DRIFT_REACH_FROM, DRIFT_REACH, sqrt(square));
        sum += vortex.w * share * vec2(-way.y, way.x);
    }
    return sum;
}

// @part flow_map
// The flow read from the velocity map: exact at its texels, bilinear between them, beyond the rim as at the rim. By hand: samplers
// weigh texels in 256 steps, and a way adds that up.
uniform sampler2D u_drift_flow;

vec2 drift_velocity(vec2 q) {
    return bilinear_held(u_drift_flow, DRIFT_SIZE, (0.5 + 0.5 * q / u_drift_half) * float(DRIFT_SIZE) - 0.5).xy;
}

// @part square
// The square that drift acts on; places in it are counted from its middle.
uniform float u_drift_half; // half its side, m

// @part rest
// From where the water was a whole part of a generation ago, and the next one (foam/drift_passes.glsl@still), to where it was when its
// generation came up: Hermite's cubic in time, by the velocities at both, where nothing turns by much between them. docs/formulae.md,
// section 14.
int drift_part() {
    return clamp(as_int(floor(u_drift_clock.y * (float(DRIFT_PARTS) / DRIFT_GENERATION))), 0, DRIFT_PARTS - 1);
}

vec4 drift_still_at(sampler2D still, int further) {
    return texel_at(still, as_int(floor(gl_FragCoord.xy)) + ivec2(0, (drift_part() + further) * DRIFT_SIZE));
}

vec2 drift_between(vec2 before, vec2 after) {
    const float PART = DRIFT_GENERATION / float(DRIFT_PARTS);
    float s = clamp(u_drift_clock.y / PART - float(drift_part()), 0.0, 1.0);
    if (!DRIFT_SMOOTH) {
        return drift_ago(before, s * PART);
    }
    float left = 1.0 - s;
    vec2 place = left * left * (1.0 + 2.0 * s) * before + s * s * (3.0 - 2.0 * s) * after;
    return place - PART * s * left * (left * drift_velocity(before) - s * drift_velocity(after));
}

// @part patches
// Where a generation's patches come up: three octaves of value noise, cut at a threshold.
uniform float u_drift_scale; // 1 / size of a patch, 1/m
uniform vec2 u_drift_cut;    // where the cut starts and ends, of the noise

// q: m from the square's middle. In [0, 1].
float drift_patch(uint generation, vec2 q) {
    uint key = noise_hash(uint(DRIFT_SEED) ^ noise_hash(generation));
    vec2 x = q * u_drift_scale;
    vec2 turned = vec2(0.8 * x.x - 0.6 * x.y, 0.6 * x.x + 0.8 * x.y);
    float noise = 0.55 * noise_value(key, x) + 0.3 * noise_value(key + 1u, turned * 2.3) + 0.15 * noise_value(key + 2u, x * 5.1);
    return smoothstep(u_drift_cut.x, u_drift_cut.y, noise);
}

// @part ago
// Back along the flow by the classical Runge-Kutta method: where the water that is at q now was h seconds ago.
vec2 drift_back(vec2 q, float h) {
    vec2 a = drift_velocity(q);
    vec2 b = drift_velocity(q - 0.5 * h * a);
    vec2 c = drift_velocity(q - 0.5 * h * b);
    vec2 d = drift_velocity(q - h * c);
    return q - h / 6.0 * (a + 2.0 * (b + c) + d);
}

// Where the water that is at q now was that many seconds ago, in steps as long as those of a generation or shorter.
vec2 drift_ago(vec2 q, float seconds) {
    int steps = max(as_int(ceil(seconds * (float(DRIFT_STEPS) / DRIFT_GENERATION) - 1e-3)), 1);
    float h = seconds / float(steps);
    for (int i = 0; i < steps; ++i) {
        q = drift_back(q, h);
    }
    return q;
}

// @part back
// Where it was when the next older generation came up. The youngest generation's way is shorter than a generation, the others' one each.
vec2 drift_origin(vec2 q, int j) {
    return drift_ago(q, j == 0 ? u_drift_clock.y : DRIFT_GENERATION);
}

// @part carried
// The look's mask carried by the flow: two copies, each let go every second generation and carried until the next of its kind is there.
// Each thins its foam, and what neither covers stays free (foam/cover.glsl).
float foam_amount(float f, vec2 p, Footprint fp) {
    vec2 q = p + u_drift_place;
    float rim = drift_rim(q);
    vec4 way;
    vec4 along_x;
    vec4 along_z;
    drift_ways(q, way, along_x, along_z);
    float grown = sin(0.5 * PI / DRIFT_GENERATION * drift_age(0));
    bool odd = (drift_generation(0) & 1u) == 1u;
    // Beyond the square the even copy alone is left, where it would be without any flow.
    float share = rim * (odd ? grown * grown : 1.0 - grown * grown);
    vec2 left = cover_free(clamp(f, 0.0, 1.0));
    float free = 1.0;
    // Asked at the end: drivers without branches would go through both where one has all the weight.
    int i = odd == (share > 0.0) ? 0 : 1;
    int copies = share > 0.0 && share < 1.0 ? 2 : 1;
    do {
        bool shifted = odd == (i == 0);
        vec2 back = rim * (i == 0 ? way.xy : way.zw);
        vec2 turn_x = rim * (i == 0 ? along_x.xy : along_x.zw);
        vec2 turn_z = rim * (i == 0 ? along_z.xy : along_z.zw);
        Footprint own = Footprint(fp.x + turn_x * fp.x.x + turn_z * fp.x.y, fp.y + turn_x * fp.y.x + turn_z * fp.y.y);
        vec2 apart = shifted ? vec2(DRIFT_APART_X, DRIFT_APART_Z) : vec2(0.0);
        free *= 1.0 - still_amount(cover_part(left, shifted ? share : 1.0 - share), p + back + apart, own);
        i = 1 - i;
        copies -= 1;
    } while (copies > 0);
    return 1.0 - free;
}

// @part way_exact
// The ways back, gone at each sample, and how they change along x and z, a unit, over 2 cm: less is lost in float32's rounding.
vec4 drift_way(vec2 q) {
    vec2 first = drift_origin(q, 0);
    return vec4(first - q, drift_origin(first, 1) - q);
}

void drift_ways(vec2 q, out vec4 way, out vec4 along_x, out vec4 along_z) {
    way = drift_way(q);
    along_x = (drift_way(q + vec2(0.02, 0.0)) - way) / 0.02;
    along_z = (drift_way(q + vec2(0.0, 0.02)) - way) / 0.02;
}

// @part way_map
// The ways back read from their map, bilinear, and how they change along x and z, a unit. By hand: a sampler's 256 steps between
// texels would show as steps of the mask.
uniform sampler2D u_drift_way;

void drift_ways(vec2 q, out vec4 way, out vec4 along_x, out vec4 along_z) {
    float texels = float(DRIFT_SIZE) / (2.0 * u_drift_half);
    vec2 at = clamp((q + u_drift_half) * texels - 0.5, 0.0, float(DRIFT_SIZE - 1));
    ivec2 low = min(as_int(floor(at)), DRIFT_SIZE - 2);
    vec2 t = at - vec2(low);
    vec4 a = texel_at(u_drift_way, low);
    vec4 b = texel_at(u_drift_way, low + ivec2(1, 0));
    vec4 c = texel_at(u_drift_way, low + ivec2(0, 1));
    vec4 d = texel_at(u_drift_way, low + ivec2(1, 1));
    way = bilinear(a, b, c, d, t);
    along_x = mix(b - a, d - c, t.y) * texels;
    along_z = mix(c - a, d - b, t.x) * texels;
}
