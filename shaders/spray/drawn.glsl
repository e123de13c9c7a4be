// Drops as they are drawn: their flight, size and light.

// @part flight
// A drop: its chances, and ballistics with linear drag in closed form. docs/formulae.md, section 13.
uniform vec2 u_spray_wind; // m/s

// What is thrown up: sheets that tear into ligaments and drops, puffs of mist, spindrift, and the water of a blast's column.
const float SPRAY_SHEET = 0.0;
const float SPRAY_MIST = 1.0;
const float SPRAY_DRIFT = 2.0;
const float SPRAY_COLUMN = 3.0;

// birth: from the eye along x and z, its height, m; velocity: m/s; age and life: s; radius: m at birth; strength: its share of the
// full opacity.
struct Drop {
    vec3 birth;
    vec3 velocity;
    float age;
    float life;
    float radius;
    float strength;
    float kind;
    uint word;
};

// The k-th number in [0, 1) that goes with a word.
float spray_part(uint word, uint k) {
    return noise_share(noise_hash(word + k));
}

// Velocity at which a drop no longer speeds up or slows down, m/s. tau: time in which the air takes a drop to 1/e of its speed against
// that, s; weight: its fall without air, m/s2.
vec3 spray_last(float tau, float weight) {
    return vec3(u_spray_wind.x, -weight * tau, u_spray_wind.y);
}

// Where a drop is, age seconds after its birth.
vec3 spray_flight(vec3 birth, vec3 velocity, float age, float tau, float weight) {
    vec3 last = spray_last(tau, weight);
    return birth + last * age + (velocity - last) * (tau * (1.0 - exp(-age / tau)));
}

// And how fast.
vec3 spray_speed(vec3 velocity, float age, float tau, float weight) {
    vec3 last = spray_last(tau, weight);
    return last + (velocity - last) * exp(-age / tau);
}

// @part form
// How a drop's water spreads and tears as it flies. docs/formulae.md, section 13.
// radius: in those of its birth; moment: how long a streak its flight leaves, s; longest: that streak at most, in radii; depth: optical
// depth of its middle; cover: share that is covered there; soft: of the strands' edges.
struct SprayForm {
    float radius;
    float moment;
    float longest;
    float depth;
    float cover;
    float soft;
};

SprayForm spray_form(float kind, float age, float life, float vary, float other) {
    float x = max(age, 0.0) / life;
    float ends = 1.0 - smoothstep(0.55, 1.0, x);
    float begins = smoothstep(0.0, 0.06, x);
    if (kind == SPRAY_MIST) {
        float grown = (0.5 + 0.5 * vary) * (1.0 + 2.2 * x);
        return SprayForm(grown, 0.2, 1.5, 0.9 * ends * begins / (0.4 + grown * grown), 0.85, 0.7);
    }
    if (kind == SPRAY_DRIFT) {
        // A veil: strands that are long and sharp would stand as a comb, and what is dense while small as dashes.
        float grown = (0.8 + 0.8 * vary) * (1.0 + 3.0 * x);
        float thick = 0.45 * (1.0 - x) * ends * smoothstep(0.0, 0.2, x);
        return SprayForm(grown, 0.3, 3.0, thick / (0.3 + grown), 1.0, 1.0);
    }
    if (kind == SPRAY_COLUMN) {
        float grown = (0.6 + 0.8 * vary) * (1.0 + 1.6 * x);
        return SprayForm(grown, 0.15, 3.0, 1.8 * ends * smoothstep(0.0, 0.02, x) / (0.4 + 0.6 * grown), mix(1.1, 0.3, smoothstep(0.05, 0.8, x)), 0.3);
    }
    // Sheet, ligaments, drops.
    float grown = (0.35 + 0.9 * vary * vary) * (1.0 + 1.4 * x);
    return SprayForm(grown, 0.15, 2.5, 1.2 * ends * begins, mix(0.8, 0.18, smoothstep(0.0, 0.6, x)) * (0.6 + 0.4 * other), 0.22);
}

// @part drop
// Optical depth of a drop's water at a sample, and its light times that: depths add up in any order.
uniform sampler2D u_spray_strands; // ranks: low on the strands, lowest at their beads
in vec2 v_at;
flat in vec3 v_scattered;
flat in vec3 v_onward;
flat in vec3 v_sun;
flat in vec4 v_strands;
flat in vec3 v_form;
flat in float v_fine;
out vec4 o_thick;

void main() {
    float square = dot(v_at, v_at);
    if (square >= 1.0) {
        discard;
    }
    float within = 1.0 - square;
    vec2 way = v_at * vec2(v_strands.z, 0.5 * SPRAY_WINDOW);
    float rank = textureLod(u_spray_strands, v_strands.xy + way, v_strands.w).r;
    float cover = clamp((v_form.y * within - rank) / v_form.z + 0.5, 0.0, 1.0);
    // Near the eye strands are drops themselves: the same ranks, SPRAY_FINER times finer and turned.
    if (v_fine > 0.0) {
        float fine = textureLod(u_spray_strands, v_strands.yx + SPRAY_FINER * vec2(way.y, -way.x), v_strands.w + log2(SPRAY_FINER)).r;
        cover = mix(cover, clamp((cover - fine) / 0.3 + 0.5, 0.0, 1.0), v_fine);
    }
    if (cover <= 0.0) {
        discard;
    }
    float depth = v_form.x * within * cover;
    float facing = 0.75 + 0.25 * dot(vec3(v_at, sqrt(within)), v_sun);
    o_thick = vec4((v_scattered * facing + v_onward * exp(-1.5 * depth)) * depth, depth);
}

// @part vertex
// A drop's quadrilateral: along its flight as the eye sees it, as long as it moves in a moment. What is not seen has no area.
uniform sampler2DArray u_spray_air;
out vec2 v_at;             // place in it, its rim at length 1
flat out vec3 v_scattered;
flat out vec3 v_onward;
flat out vec3 v_sun;       // toward the sun: along the flight, across, toward the eye
flat out vec4 v_strands;   // first place in the texture, texels over half the length, level
flat out float v_fine;      // share of the finer strands
flat out vec3 v_form;      // optical depth of the middle, share that is covered there, softness of the strands

void main() {
    int i = gl_VertexID / 6;
    gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
    v_at = vec2(0.0);
    v_scattered = vec3(0.0);
    v_onward = vec3(0.0);
    v_sun = vec3(0.0);
    v_strands = vec4(0.0);
    v_form = vec3(0.0);
    v_fine = 0.0;
    vec4 air = spray_entry(u_spray_air, i, 0);
    if (air.w <= 0.0) {
        return;
    }
    vec4 thrown = spray_entry(u_spray_births, i, 1);
    vec4 traits = spray_entry(u_spray_births, i, 2);
    uint word = uint(traits.z);
    float vary = spray_part(word, 6u);
    float age = spray_entry(u_spray_births, i, 0).w;
    vec2 fall = spray_fall(traits.y, vary);
    vec3 velocity = spray_speed(thrown.xyz, age - spray_rides(traits.y, word, age), fall.x, fall.y);
    SprayForm form = spray_form(traits.y, age - spray_delay(traits.y, spray_part(word, 8u)), traits.w, vary, spray_part(word, 9u));
    float depth = dot(air.xyz, u_ray_z);
    vec2 squares = vec2(dot(u_ray_x, u_ray_x), dot(u_ray_y, u_ray_y));
    vec2 clip = vec2(dot(air.xyz, u_ray_x), dot(air.xyz, u_ray_y)) / (squares * depth);
    vec2 moves = (vec2(dot(velocity, u_ray_x), dot(velocity, u_ray_y)) / squares - clip * dot(velocity, u_ray_z)) / depth;
    // Heights of a sample: half the width, and half the length.
    moves *= 0.5 * u_viewport * (SPRAY_WIDER * form.moment);
    vec4 scattered = spray_entry(u_spray_air, i, 1);
    float unit = 0.5 * u_viewport.y / length(u_ray_y);
    float scale = unit / depth;
    // No larger than its height over the surface lets it be: what is drawn below would stand before the water.
    float radius = thrown.w * form.radius;
    float wide = min(radius, 0.5 * radius + scattered.w) * scale;
    float longer = length(moves) * min(scattered.w / max(abs(velocity.y) * form.moment, 1e-3), 1.0);
    vec2 along = length(moves) > 1e-4 ? normalize(moves) : vec2(0.0, 1.0);
    vec2 size = vec2(wide + min(longer, form.longest * wide), wide);
    // Narrower than a sample and a half: as wide, and hides as much.
    vec2 drawn = max(size, 0.75);
    float thin = size.x * size.y / (drawn.x * drawn.y);
    v_at = quad_corner();
    vec2 place = v_at.x * drawn.x * along + v_at.y * drawn.y * vec2(-along.y, along.x);
    v_scattered = scattered.rgb;
    v_onward = spray_entry(u_spray_air, i, 2).rgb;
    v_sun = spray_sunward(along);
    float texels = 0.5 * SPRAY_WINDOW * float(SPRAY_STRANDS);
    float sharp = log2(texels / drawn.y);
    float level = clamp(sharp, 0.0, 5.0);
    float window = 0.5 * SPRAY_WINDOW;
    v_strands = vec4(spray_part(word, 10u), spray_part(word, 11u), window * min(drawn.x / drawn.y, 2.0), level);
    v_fine = 1.0 - clamp((sharp + 2.0) / 2.0, 0.0, 1.0);
    // What spans so much of the view is a cloud that the eye is in.
    vec2 wide_as = traits.y == SPRAY_DRIFT ? vec2(0.013, 0.06) : vec2(0.06, 0.2);
    float around = traits.y == SPRAY_COLUMN ? 0.0 : smoothstep(wide_as.x, wide_as.y, size.x / (SPRAY_WIDER * unit));
    float opacity = traits.x * air.w * smoothstep(0.3, 1.0, depth) * (1.0 - around);
    float hides = 1.0 - exp(-form.depth * opacity);
    v_form = vec3(-log(1.0 - min(thin * hides, 0.999)), form.cover, mix(form.soft, 1.0, level / 5.0));
    gl_Position = vec4(clip + 2.0 * place / u_viewport, 0.0, 1.0);
}

// @part lit
// Light of a drop toward the eye, with the air before it. d: from the eye, a unit vector; sun: the share of the sun
// that reaches it. Held: a screen is white long before.
const float SPRAY_BRIGHTEST = 64.0;

// Sun and sky scattered all round. face: where the water beside it ends.
vec3 spray_scattered(vec3 face, vec3 d, float sun, float distance_to_eye) {
    vec3 light = (u_sun_irradiance * (sun * (0.5 + 0.4 * dot(face, u_sun_direction))) + 0.9 * u_sky_irradiance) / PI;
    return min(exposure() * hazed(light, horizon_light(d), distance_to_eye), SPRAY_BRIGHTEST);
}

// The sun's light that drops send on nearly as it came, where they are few: 0.8 of it onward in the mean (Henyey and Greenstein 1941).
vec3 spray_onward(vec3 d, float sun, float distance_to_eye) {
    float x = 1.64 - 1.6 * dot(d, u_sun_direction);
    vec3 light = u_sun_irradiance * (0.36 * sun / (2.0 * PI * x * sqrt(x)));
    return min(exposure() * light * exp(-3.912 / u_visibility * distance_to_eye), SPRAY_BRIGHTEST);
}

// @part unlit
// No light: drops are white, as foam is.
vec3 spray_scattered(vec3 face, vec3 d, float sun, float distance_to_eye) {
    return vec3(1.0);
}

vec3 spray_onward(vec3 d, float sun, float distance_to_eye) {
    return vec3(0.0);
}

// @part sunward_lit
// The sun's direction in the picture: along a direction of it, across, and toward the eye. A unit vector.
vec3 spray_sunward(vec2 along) {
    vec3 right = u_ray_x / length(u_ray_x);
    vec3 up = u_ray_y / length(u_ray_y);
    vec2 sun = vec2(dot(u_sun_direction, right), dot(u_sun_direction, up));
    return vec3(dot(sun, along), dot(sun, vec2(-along.y, along.x)), -dot(u_sun_direction, u_ray_z));
}

// @part sunward_none
// No sun.
vec3 spray_sunward(vec2 along) {
    return vec3(0.0);
}

// @part over_land
// Height of a drop over water and ground, m. drop: from the eye, m.
float spray_over(vec3 drop) {
    return drop.y + u_eye_height - max(waves(drop.xz).x, shore_floor(shore_place(drop.xz)).x);
}

// Whether water or land is before a drop. depth: of it along the view, m.
bool spray_hidden(vec3 drop, float depth) {
    float tau;
    vec3 wave;
    if (find_surface(drop / depth, 0.999 * depth, tau, wave)) {
        return true;
    }
    vec4 ground;
    return find_land(drop / depth, 0.999 * depth, tau, ground);
}

// @part over_water
// Height of a drop over the water, m. drop: from the eye, m.
float spray_over(vec3 drop) {
    return drop.y + u_eye_height - waves(drop.xz).x;
}

// Whether water is before a drop. depth: of it along the view, m.
bool spray_hidden(vec3 drop, float depth) {
    float tau;
    vec3 wave;
    return find_surface(drop / depth, 0.999 * depth, tau, wave);
}

// @part past_boats
// Whether water, land or a boat is before a drop. depth: of it along the view, m.
bool spray_hidden(vec3 drop, float depth) {
    vec3 eye = vec3(0.0, u_eye_height, 0.0);
    float away = length(drop);
    float t;
    BoatHit hit;
    return trace_boats(eye, drop / away, 0.0, 0.999 * away, false, t, hit) >= 0 || spray_hidden_openly(drop, depth);
}
