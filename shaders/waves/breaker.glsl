// A plunging crest: its section, where rays meet it, and how it looks. docs/formulae.md, section 17.

// @part course
// Where crests break.
uniform vec2 u_breaker_front; // way along the last crest from where none has risen to where its face is vertical, way of that from crest to crest
uniform vec4 u_breaker_form;  // height (m), way along it until the jet lands, length, advance over the way along it
uniform vec4 u_breaker_place; // from where it begins to overturn to the eye x, z (m), direction of its travel

// As many turns of a loop, which compilers cannot tell: each would be a copy of it in the program.
int crest_turns(int turns) {
    return u_breaker_form.x > 0.0 ? turns : 0;
}

// @part left
// Foam that crests leave on the water over which what they throw up has run, to where nothing is left of them. f in [0, BREAKER_CAP].
uniform vec2 u_breaker_foam; // saturation, way of the faces until it is 1/e

// on: along the travel from where crests begin to overturn, and along them, in their heights. patches: that it is torn into, [0, 1].
float breaker_left(vec2 on, float patches) {
    // Where along the crest its face was vertical when the bore came here; ways of the jet until it lands that it had run.
    float front = (on.x - CREST_FOOT) / u_breaker_form.w;
    float land = (front - on.y) / u_breaker_form.y;
    float ran = smoothstep(0.0, PLUNGING_TAPER * u_breaker_form.z, min(on.y, u_breaker_form.z - on.y));
    ran *= smoothstep(0.9, 1.6, land + 0.5 * patches - 0.25) * (1.0 - smoothstep(4.0, PLUNGING_TAIL, land));
    // Way of the faces since the last crest passed here.
    float since = mod(u_breaker_front.x - PLUNGING_SHOULDER - front, u_breaker_front.y);
    return min(u_breaker_foam.x * ran * exp(-since / u_breaker_foam.y) * (0.3 + 0.9 * patches), BREAKER_CAP);
}

// @part saturation
// The same torn into patches.
float breaker_saturation(vec2 p, float height, Footprint fp) {
    vec2 ahead = u_breaker_place.zw;
    vec2 from = (p + u_breaker_place.xy) / u_breaker_form.x;
    vec2 on = vec2(dot(from, ahead), CREST_SIDE * dot(from, vec2(-ahead.y, ahead.x)));
    // Most water has none.
    if (breaker_left(on, 1.0) == 0.0) {
        return 0.0;
    }
    vec2 turned = vec2(0.8 * on.x - 0.6 * on.y, 0.6 * on.x + 0.8 * on.y);
    vec2 torn = TORN_NONE;
    float cell = CREST_CELL;
    for (int i = 0; i < crest_turns(3); ++i) {
        float share = i == 0 ? 0.4 : i == 1 ? 0.35 : 0.25;
        torn = torn_noise(torn, share, cell * u_breaker_form.x, noise_value(NOISE_KEY, turned / cell), fp);
        cell *= 0.35;
    }
    return breaker_left(on, torn_step(0.25, 0.72, torn.x, torn.y));
}

// @part section
// The crest as a solid. Places are (x, y, s): along its travel from its first vertical face, up, and along it, in its heights.

const float CREST_LEAST = 1e-3; // of a height that divides
const int CREST_TOP = 0;
const int CREST_FACE = 1;
const int CREST_UNDER = 2;
const int CREST_LUMPS = 3;
const int CREST_WHOLE = 4;

struct Crest {
    float high;  // height
    float lean;  // share of the unbroken face's lean
    float land;  // way behind the first vertical face, in ways until the jet lands
    float lumps; // height of what is thrown up
};

// Of those under way, which one is looked at: the way from where crests begin to overturn to where its face is vertical.
float crest_from = 0.0;

void look_at_crest(int i) {
    crest_from = u_breaker_front.x + float(i) * u_breaker_front.y - PLUNGING_SHOULDER;
}

float crest_front() {
    return crest_from;
}

Crest crest_at(float s) {
    float ahead = s - crest_front();
    float land = max(-ahead, 0.0) / u_breaker_form.y;
    float taper = PLUNGING_TAPER * u_breaker_form.z;
    float ends = smoothstep(0.0, taper, min(s, u_breaker_form.z - s));
    float left = ends * (1.0 - smoothstep(4.0, PLUNGING_TAIL, land));
    float high = left * (1.0 - smoothstep(0.5, PLUNGING_SHOULDER, ahead)) * (1.0 - 0.55 * smoothstep(1.6, 4.0, land));
    return Crest(high, smoothstep(0.0, PLUNGING_LEANING, ahead), land, left * smoothstep(0.9, 2.2, land));
}

// It begins to overturn gently: after a tenth of the way it moves as evenly as the tip of a jet that falls freely.
float crest_phase(Crest c) {
    float even = min(c.land, 1.0);
    return (sqrt(even * even + CREST_GENTLE * CREST_GENTLE) - CREST_GENTLE) / (sqrt(1.0 + CREST_GENTLE * CREST_GENTLE) - CREST_GENTLE);
}

float crest_tip(Crest c) {
    return PLUNGING_THROW * crest_phase(c);
}

float crest_behind(Crest c) {
    return -PLUNGING_BORE * crest_phase(c);
}

// Height of the back, and before a crest that has begun to overturn of the jet's top.
float crest_top(Crest c, float x) {
    float behind = min(x, 0.0) / PLUNGING_LENGTH;
    // No farther than it lands, or the gap would grow faster than what is left of the way.
    float ahead = c.land > 0.0 ? clamp(x, 0.0, 1.2) : 0.0;
    float back = max(1.0 - behind * behind, 0.0);
    return back * back - (1.0 - PLUNGING_FOREMOST) * ahead * ahead;
}

// x of the face: of the ellipse, straight up over its vertical place, and ahead where it leans.
float crest_face(Crest c, float y) {
    float up = clamp(y, 0.0, PLUNGING_VERTICAL) - PLUNGING_HALF_HEIGHT;
    // Rounding at the lowest place must not make a root of less than 0.
    float root = sqrt(max(PLUNGING_XX * PLUNGING_LONG * PLUNGING_LONG - 3.0 * up * up, 0.0));
    float lean = PLUNGING_LEAN * sqrt(1.0 - sqrt(clamp(y, 0.0, 1.0)));
    return crest_behind(c) + PLUNGING_HALF_WIDTH - (PLUNGING_XZ * up + root) / PLUNGING_XX + c.lean * lean;
}

// Way to the jet's tip, in shares of its width.
float crest_left(Crest c, float x) {
    return clamp((crest_tip(c) - x) / max(crest_tip(c) - crest_behind(c), CREST_LEAST), 0.0, 1.0);
}

float crest_jet(Crest c, float left) {
    return (crest_top(c, crest_behind(c)) - PLUNGING_VERTICAL) * (1.0 - sqrt(1.0 - left * left));
}

// Share of foam on the water around it.
float crest_apron(Crest c, float x) {
    float wide = clamp(c.land - 0.9, 0.0, 4.0);
    float v = (x - 0.9) / (0.5 + 0.65 * wide);
    return c.lumps * max(1.0 - v * v, 0.0);
}

// What the jet throws up where it has landed, which grows wide and covers what is left of the crest.
float crest_lumps(Crest c, vec3 p) {
    float past = clamp(c.land - 1.0, 0.0, 3.0);
    float v = (p.x - 1.25 + 0.3 * past) / (0.6 + 0.5 * past);
    // It splashes up before it runs on.
    float up = 0.35 + 0.35 * (1.0 - smoothstep(1.5, 2.8, c.land));
    float most = up * c.lumps * max(1.0 - v * v, 0.0);
    float apron = CREST_APRON * smoothstep(0.0, 0.2, crest_apron(c, p.x));
    vec2 place = vec2(p.z, p.x + 0.6 * crest_front()) / CREST_LUMP;
    float noise = 0.0;
    float share = 1.0;
    // Over all that it may reach there is no need to know how high it is.
    for (int i = 0; i < crest_turns(p.y < apron + 1.3 * most ? 3 : 0); ++i) {
        noise += share * abs(noise_2(place, uint(CREST_SEED + i)));
        share *= 0.45;
        place *= 2.3;
    }
    return apron + most * (1.3 - 0.8 * exp(-4.0 * noise));
}

// Ways out of what is under the top, behind the face, and in the jet.
vec3 crest_gaps(vec3 p) {
    Crest c = crest_at(p.z);
    float high = max(c.high, CREST_LEAST);
    vec2 at = p.xy / high;
    float top = crest_top(c, at.x);
    float jet = max(top - crest_jet(c, crest_left(c, at.x)) - at.y, at.x - crest_tip(c));
    return high * vec3(at.y - top, at.x - crest_face(c, at.y), jet);
}

float crest_gap(vec3 gaps, int part) {
    return part == CREST_WHOLE ? max(gaps.x, min(gaps.y, gaps.z)) : gaps[part];
}

// Which part gives the whole its gap.
int crest_part(vec3 gaps) {
    return gaps.x >= min(gaps.y, gaps.z) ? CREST_TOP : gaps.y <= gaps.z ? CREST_FACE : CREST_UNDER;
}

float crest_lump_gap(vec3 p) {
    return p.y - crest_lumps(crest_at(p.z), p);
}

// The crest's axes: along its travel, up, and along it.
mat3 crest_axes() {
    vec2 ahead = u_breaker_place.zw;
    return mat3(vec3(ahead.x, 0.0, ahead.y), vec3(0.0, 1.0, 0.0), CREST_SIDE * vec3(-ahead.y, 0.0, ahead.x));
}

// A place, m from under the eye, along the crest's axes.
vec3 crest_place(vec3 place) {
    vec3 from = (place + vec3(u_breaker_place.x, 0.0, u_breaker_place.y)) * crest_axes() / u_breaker_form.x;
    return from - vec3(u_breaker_form.w * crest_front(), 0.0, 0.0);
}

// Corners of the box of all that there is.
vec3 crest_low() {
    return vec3(-PLUNGING_LENGTH, CREST_LOWEST, max(crest_front() - PLUNGING_TAIL * u_breaker_form.y, 0.0));
}

vec3 crest_high() {
    return vec3(PLUNGING_FRONT, 1.0, min(u_breaker_form.z, crest_front() + PLUNGING_SHOULDER));
}

// @part vertex
// The rectangle of the picture that holds the boxes of all crests, and three samples more.
const float CREST_NEAREST = 1e-2; // of a corner before the eye, m

void main() {
    vec2 squares = vec2(dot(u_ray_x, u_ray_x), dot(u_ray_y, u_ray_y));
    vec2 least = vec2(1e30);
    vec2 most = vec2(-1e30);
    float nearest = 1e30;
    float farthest = -1e30;
    for (int i = 0; i < CREST_COUNT; ++i) {
        look_at_crest(i);
        vec3 low = crest_low();
        vec3 high = crest_high();
        // One that is past, or has not begun, has no length.
        for (int corner = 0; corner < (low.z < high.z ? 8 : 0); ++corner) {
            vec3 local = mix(low, high, vec3(corner & 1, (corner >> 1) & 1, corner >> 2));
            local.x += u_breaker_form.w * crest_front();
            vec3 place = u_breaker_form.x * crest_axes() * local - vec3(u_breaker_place.x, u_eye_height, u_breaker_place.y);
            float depth = dot(place, u_ray_z);
            vec2 clip = vec2(dot(place, u_ray_x), dot(place, u_ray_y)) / (squares * max(depth, CREST_NEAREST));
            least = min(least, clip);
            most = max(most, clip);
            nearest = min(nearest, depth);
            farthest = max(farthest, depth);
        }
    }
    // Boxes that are partly behind the eye may show anywhere, those that are wholly behind it nowhere.
    bool shows = farthest > 0.0;
    vec2 pad = 6.0 / u_viewport;
    vec2 from = nearest <= CREST_NEAREST ? vec2(-1.0) : clamp(least - pad, -1.0, 1.0);
    vec2 to = nearest <= CREST_NEAREST ? vec2(1.0) : clamp(most + pad, -1.0, 1.0);
    gl_Position = shows ? vec4(mix(from, to, greaterThan(quad_corner(), vec2(0.0))), FULLSCREEN_DEPTH, 1.0) : vec4(2.0, 2.0, 2.0, 1.0);
}

// @part trace
// Where a ray enters the crest from the air, in its heights along d, and which part of it; false where it does not.
const int CREST_HALVINGS = 12;

// Where a ray is in a box; from after to before: nowhere.
vec2 crest_span(vec3 o, vec3 d, vec3 low, vec3 high) {
    vec3 way = mix(d, vec3(1e-9), lessThan(abs(d), vec3(1e-9)));
    vec3 enters = min((low - o) / way, (high - o) / way);
    vec3 leaves = max((low - o) / way, (high - o) / way);
    return low.z < high.z ? vec2(max(max(max(enters.x, enters.y), enters.z), 0.0), min(min(leaves.x, leaves.y), leaves.z)) : vec2(1.0, 0.0);
}

// What is entered between two places: the whole, or where both are in the air the jet alone, by its top or from under it, which may be
// thinner than a step. -1: nothing.
int crest_entered(vec3 before, vec3 after, int from) {
    int kind = -1;
    for (int i = 2; i >= 0; --i) {
        int one = i == 0 ? CREST_TOP : i == 1 ? CREST_UNDER : CREST_WHOLE;
        kind = i >= from && crest_gap(before, one) > 0.0 && crest_gap(after, one) < 0.0 ? i : kind;
    }
    return kind;
}

// Steps, and where something is entered halvings, in one loop: drivers without branches would run a loop in it for every step.
bool meet_body(vec3 o, vec3 d, out float t, out int part, out bool clear) {
    vec2 span = crest_span(o, d, crest_low(), crest_high());
    float least = (span.y - span.x) / float(CREST_STEPS);
    int halvings = 0;
    int entered = -1;
    // The first step ends where the ray enters the box.
    float before = span.x - least;
    vec2 held = vec2(0.0);
    vec3 gaps = vec3(0.0);
    vec3 ahead = gaps;
    t = 1e9;
    part = CREST_TOP;
    clear = true;
    bool on = span.x < span.y;
    while (on) {
        bool marches = halvings == 0;
        float whole = crest_gap(gaps, CREST_WHOLE);
        // The gap is no more than twice as wide as the way out, but for the foot, where what comes next is deep water.
        float after = min(before + max(0.5 * whole, least), span.y);
        float look = marches ? after : 0.5 * (held.x + held.y);
        vec3 there = crest_gaps(o + look * d);
        int kind = entered == 0 ? CREST_TOP : entered == 1 ? CREST_UNDER : CREST_WHOLE;
        // From in the crest nothing of it is seen.
        bool dry = span.x > 0.0 || crest_gap(there, CREST_WHOLE) >= 0.0;
        clear = before < span.x ? dry : clear;
        // What is entered in this interval, or what else in the last.
        int next = crest_entered(gaps, marches ? there : ahead, marches ? 0 : entered + 1);
        if (marches) {
            entered = next;
            held = vec2(before, after);
            ahead = there;
            halvings = entered < 0 ? 0 : CREST_HALVINGS;
            before = entered < 0 ? after : before;
            gaps = entered < 0 ? there : gaps;
            on = clear && (entered >= 0 || after < span.y);
        } else {
            bool out_there = crest_gap(there, kind) > 0.0;
            held = out_there ? vec2(look, held.y) : vec2(held.x, look);
            halvings -= 1;
            vec3 at = o + look * d;
            Crest c = crest_at(at.z);
            bool top = at.x <= crest_tip(c) * max(c.high, CREST_LEAST);
            bool under = there.x < 0.0 && there.y > 0.0;
            bool ends = halvings == 0;
            bool valid = ends && (kind == CREST_WHOLE || (kind == CREST_TOP ? top : under)) && held.y < t;
            t = valid ? held.y : t;
            part = valid ? (kind == CREST_WHOLE ? crest_part(there) : kind) : part;
            float far = before + max(0.5 * whole, least);
            entered = ends ? next : entered;
            held = ends ? vec2(before, min(far, span.y)) : held;
            halvings = ends && next >= 0 ? CREST_HALVINGS : halvings;
            bool leaves = ends && next < 0;
            on = !leaves || (t == 1e9 && far < span.y);
            before = leaves ? min(far, span.y) : before;
            gaps = leaves ? ahead : gaps;
        }
    }
    return t < 1e9;
}

// The same of what is thrown up: steps, then halvings.
bool meet_lumps(vec3 o, vec3 d, float farthest, out float t) {
    float landed = crest_front() - 0.9 * u_breaker_form.y;
    vec2 span = crest_span(o, d, crest_low() + vec3(1.5, 0.0, 0.0), vec3(PLUNGING_FRONT, 0.95, min(crest_high().z, landed)));
    float least = (min(span.y, farthest) - span.x) / float(CREST_STEPS);
    vec2 held = vec2(span.x);
    int step = 0;
    bool met = false;
    bool dry = span.x > 0.0;
    bool on = least > 0.0;
    while (on) {
        float look = met ? 0.5 * (held.x + held.y) : held.x + least;
        bool wet = crest_lump_gap(o + look * d) < 0.0;
        bool inside = wet && dry;
        dry = dry || !wet;
        held = inside ? vec2(held.x, look) : met ? vec2(look, held.y) : vec2(look);
        // From the first place inside on, as many halvings.
        step = inside && !met ? CREST_STEPS - CREST_HALVINGS : step + 1;
        met = met || inside;
        on = step < CREST_STEPS;
    }
    t = held.y;
    return met;
}

bool meet_crest(vec3 o, vec3 d, out float t, out int part) {
    float lumps;
    bool clear;
    bool body = meet_body(o, d, t, part, clear);
    bool thrown = meet_lumps(o, d, body ? t : clear ? 1e9 : -1.0, lumps);
    part = thrown ? CREST_LUMPS : part;
    t = thrown ? lumps : t;
    return body || thrown;
}

// The gap of a part, or where that is steep what it is the zero of, without a root: the jet's underside is vertical where it leaves the face,
// and a face that leans is level at the crest.
const int CREST_CAP = 5;

float crest_form(vec3 p, int form) {
    if (form == CREST_LUMPS) {
        return crest_lump_gap(p);
    }
    if (form < CREST_UNDER) {
        return crest_gaps(p)[form];
    }
    Crest c = crest_at(p.z);
    vec2 at = p.xy / max(c.high, CREST_LEAST);
    if (form == CREST_CAP) {
        float ahead = at.x / max(PLUNGING_LEAN * c.lean, CREST_LEAST);
        float fall = max(1.0 - ahead * ahead, 0.0);
        return at.y - fall * fall;
    }
    float left = (crest_tip(c) - at.x) / max(crest_tip(c) - crest_behind(c), CREST_LEAST);
    float down = 1.0 - (crest_top(c, at.x) - at.y) / (crest_top(c, crest_behind(c)) - PLUNGING_VERTICAL);
    return 1.0 - left * left - down * down;
}

// Unit normal along the crest's axes.
vec3 crest_normal(vec3 p, int part) {
    const float STEP = 2e-3;
    Crest c = crest_at(p.z);
    bool cap = part == CREST_FACE && p.y > 0.9 * max(c.high, CREST_LEAST) && c.lean > 0.02;
    int form = cap ? CREST_CAP : part;
    vec3 n = vec3(0.0);
    for (int i = 0; i < crest_turns(6); ++i) {
        vec3 by = STEP * vec3(equal(ivec3(i >> 1), ivec3(0, 1, 2))) * ((i & 1) == 0 ? 1.0 : -1.0);
        n += by * crest_form(p + by, form);
    }
    return normalize(n);
}

// @part look
// What shows of the crest at a place. Water moves through it along its travel: up the face, and level on top.
struct CrestLook {
    float way;        // along the water's way, from where it is level
    float drawn;      // scale of foam along it
    float saturation;
    float thickness;  // of water that light passes, m
    float sheet;      // 1 in the jet, through which light passes whichever way it goes
    float mirror;     // share of the sky that the place sees
    float soft;       // how much of its normal foam has from above: light goes through lumps from all sides
};

CrestLook crest_look(vec3 p, int part) {
    Crest c = crest_at(p.z);
    float high = max(c.high, CREST_LEAST);
    vec2 at = p.xy / high;
    float behind = crest_behind(c);
    float left = crest_left(c, at.x);
    float up = clamp(at.y, 0.0, 1.0);
    float back = PLUNGING_LENGTH * sqrt(1.0 - sqrt(up));
    float joint = PLUNGING_LENGTH * sqrt(1.0 - sqrt(PLUNGING_VERTICAL)) - (1.0 - PLUNGING_VERTICAL);
    float thick = crest_jet(c, left) + joint * left * left * left * left * left * left + max(behind - at.x, 0.0);
    thick = part == CREST_UNDER ? mix(back, thick, smoothstep(0.0, 0.4, crest_phase(c))) : thick;
    thick = part == CREST_FACE ? max(at.x + back, 0.0) : part == CREST_LUMPS ? 9.0 : thick;

    float toe = behind + PLUNGING_HALF_WIDTH + PLUNGING_XZ / PLUNGING_XX * PLUNGING_HALF_HEIGHT + PLUNGING_LEAN * c.lean;
    float risen = toe - 0.6 * (toe - at.x) - 0.9 * at.y;
    float bent = (1.0 - PLUNGING_VERTICAL) * sqrt(1.0 - left * left);
    float roof = toe - 0.6 * (toe - behind) - 0.9 * (PLUNGING_VERTICAL + bent) + behind - at.x;
    float way = part == CREST_FACE ? risen : part == CREST_UNDER ? roof : at.x;

    float landed = 0.9 * smoothstep(0.7, 1.5, c.land);
    float lip = smoothstep(0.45, 0.95, 1.0 - left) * smoothstep(0.0, 0.4, crest_phase(c));
    float steep = 1.0 - c.lean;
    float feather = smoothstep(-0.6, 0.0, at.x) * steep * steep * steep;
    float streaks = 0.3 * smoothstep(0.1, 0.9, at.y) * steep * steep * (0.4 + 0.6 * crest_phase(c));
    float clear = part == CREST_TOP ? max(0.3 * feather, lip) : part == CREST_FACE ? streaks : max(lip, streaks);
    float white = part == CREST_TOP ? smoothstep(-3.5, -0.5, at.x) * landed : landed;
    float shade = 1.0 - 0.6 * clamp(crest_tip(c) - at.x, 0.0, 1.0) * smoothstep(0.0, 0.3, at.y);
    return CrestLook(
        u_breaker_form.w * crest_front() + high * way,
        part == CREST_LUMPS ? 1.0 : CREST_STREAK,
        part == CREST_LUMPS ? max(smoothstep(0.0, 0.04, p.y - CREST_APRON), 0.93 * crest_apron(c, p.x)) : max(clear, white),
        thick * high * u_breaker_form.x,
        part == CREST_UNDER ? 1.0 : part == CREST_TOP ? smoothstep(0.0, 0.3, at.x) : 0.0,
        part == CREST_FACE || part == CREST_UNDER ? shade : 1.0,
        part == CREST_LUMPS ? CREST_SOFT : 0.0);
}

// @part light
// Light through the crest, and what it mirrors.
uniform float u_breaker_glow; // translucency

vec3 crest_behind_light = vec3(0.0);
float crest_thickness = 0.0;
float crest_passes = 1.0;
float crest_mirror = 1.0;

void look_through_crest(vec3 d, vec3 n, CrestLook look) {
    vec3 behind = refracted(d, n, max(-dot(d, n), 0.0), INDEX);
    // What goes down meets deep water, not the crest's back.
    crest_passes = mix(smoothstep(-0.45, -0.05, behind.y), 1.0, look.sheet);
    behind.y = length(vec2(behind.y, CREST_RAISED));
    float ahead = max(dot(d, u_sun_direction), 0.0);
    ahead *= ahead;
    crest_behind_light = 0.9 * sky_light(normalize(behind)) + u_breaker_glow / PI * ahead * ahead * u_sun_irradiance;
    crest_thickness = look.thickness;
    // What is mirrored under the horizon is water.
    crest_mirror = look.mirror * mix(0.3, 1.0, smoothstep(-0.4, 0.0, reflect(d, n).y));
}

// The crest's back holds much of the light by total reflection, as if the water were cloudy.
vec3 water_body(vec3 below, vec3 deep, vec3 extinction, float cv, float height) {
    return mix(deep, crest_behind_light, crest_passes * exp(-(extinction + CREST_CLOUDED / u_breaker_form.x) * crest_thickness));
}

vec3 reflected_light(vec3 place, vec3 r, vec3 spread) {
    return crest_mirror * mirrored_sky(r, spread);
}

vec3 crest_light(vec3 d, vec3 absorption, float height) {
    return vec3(0.0);
}

// @part dark
// No light: the crest is black.
void look_through_crest(vec3 d, vec3 n, CrestLook look) {
}

// @part main
// A sample of the crest where it stands before water and land. Linear light, premultiplied.
out vec4 o_color;

vec3 crest_moved(vec3 ray, float tau, vec3 n, vec3 by) {
    float facing = min(dot(n, ray), -1e-3 * length(ray));
    return tau * (by - ray * (dot(n, by) / facing));
}

void main() {
    vec3 ray = camera_ray(sample_place());
    vec3 d = normalize(ray);
    mat3 axes = crest_axes();
    vec3 eye = vec3(0.0, u_eye_height, 0.0);
    float t = 1e9;
    int part = CREST_TOP;
    int met = -1;
    for (int i = 0; i < crest_turns(CREST_COUNT); ++i) {
        look_at_crest(i);
        float way;
        int entered;
        if (meet_crest(crest_place(eye), d * axes, way, entered) && way < t) {
            t = way;
            part = entered;
            met = i;
        }
    }
    if (met < 0) {
        discard;
    }
    look_at_crest(met);
    vec3 p = crest_place(eye) + t * (d * axes);
    t *= u_breaker_form.x;
    float tau = t / length(ray);
    float water_tau;
    vec3 wave;
    if ((find_surface(ray, tau, water_tau, wave) && water_tau < tau) || crest_behind_land(ray, tau)) {
        discard;
    }
    CrestLook look = crest_look(p, part);
    vec3 local = crest_normal(p, part);
    vec3 n = axes * local;
    vec3 along = axes * normalize(vec3(local.y, -local.x, 0.0));
    vec3 step_x = crest_moved(ray, tau, n, u_ray_x * (2.0 * FOOTPRINT_X / u_viewport.x));
    vec3 step_y = crest_moved(ray, tau, n, u_ray_y * (2.0 / u_viewport.y));
    // Level water's, and drawn out along its way.
    mat2 level = mat2(axes[0].xz, axes[2].xz);
    mat2 out_of = mat2(look.drawn * level[0], level[1]);
    vec2 on_x = vec2(dot(step_x, along), dot(step_x, axes[2]));
    vec2 on_y = vec2(dot(step_y, along), dot(step_y, axes[2]));
    Footprint fine = Footprint(level * on_x, level * on_y);
    Footprint drawn = Footprint(out_of * on_x, out_of * on_y);
    vec2 way = u_breaker_form.x * vec2(look.way, p.z);
    vec3 ripple = detail(level * way - u_breaker_place.xy, fine);
    vec2 slopes = ripple.xy * level;
    vec3 tilt = slopes.x * along + slopes.y * axes[2];
    vec3 normal = normalize(n - tilt);
    vec3 foam_normal = normalize(n - 0.5 * tilt + look.soft * vec3(0.0, 1.0, 0.0));
    float f = max(look.saturation, breaker_left(vec2(look.way, p.z), 0.5));
    float amount = f > 0.0 ? foam_amount(f, out_of * way - u_breaker_place.xy, drawn) : 0.0;
    vec3 place = eye + t * d;
    shade_sun(place, fine);
    look_through_crest(d, n, look);
    vec3 water = exposure() * water_light(place, d, normal, vec2(0.0, ripple.z), place.y, f);
    vec4 layer = foam_layer(foam_normal, d, f);
    vec3 foam = exposure() * layer.rgb + (1.0 - layer.a) * water;
    o_color = vec4(min(in_air(foam_over(water, foam, amount), d, t), BRIGHTEST), 1.0);
}

// @part none
// An eye under the water sees nothing of the crest.
out vec4 o_color;

void main() {
    discard;
}
