// Waves that stand before a wall.

// @part way
// A place seen from a stone in a current: how far behind its upstream edge, and how far to the side. docs/formulae.md, section 16.
uniform vec4 u_stone_course[STONE_COUNT]; // from the stone to the eye x, z (m), 0, radius of its course through the water (m)
uniform vec4 u_stone_form[STONE_COUNT];   // length of a hull that makes such waves (m), radius (m), length of its waves (m), 0
uniform vec2 u_stone_flow;                // direction of the current

struct StoneWay {
    float behind;    // m
    float aside;     // m
    vec2 on_behind;  // gradients along x and z
    vec2 on_aside;
};

StoneWay stone_way(int i, vec2 p) {
    vec2 from = p + u_stone_course[i].xy;
    vec2 across = vec2(-u_stone_flow.y, u_stone_flow.x);
    return StoneWay(dot(from, u_stone_flow) + u_stone_form[i].y, dot(from, across), u_stone_flow, across);
}

// @part within
// Where a ray passes over the waves behind a stone.
uniform float u_stone_lowest; // no water is lower, m

// Keeps of the span what first + rate t >= 0 holds in.
void stone_keep(float first, float rate, inout vec2 span) {
    if (rate > 1e-9) {
        span.x = max(span.x, -first / rate);
    } else if (rate < -1e-9) {
        span.y = min(span.y, -first / rate);
    } else if (first < 0.0) {
        span.y = -1.0;
    }
}

// How far behind the stone's upstream edge a ray and those beside it come over its waves at the least, m; -1: they never do. ray: from
// the eye, not normalised; aside: how far from it rays of its tile are, m a unit, and at most 1.5 times as far upright; from: where it begins.
float stone_nearest(int i, vec3 ray, float aside, float from) {
    StoneWay eye = stone_way(i, vec2(0.0));
    float behind = dot(eye.on_behind, ray.xz);
    float across = dot(eye.on_aside, ray.xz);
    vec2 span = vec2(from, 1e6);
    float over = u_eye_height - u_stone_lowest;
    if (over > 0.0) {
        // There the last of the rays is under water.
        stone_keep(over, ray.y + 1.5 * aside, span);
    }
    // Reads of a map go a texel beyond the waves.
    float room = u_stone_form[i].z * 1.7 / float(WAKE_SIZE);
    stone_keep(WAKE_ASIDE * eye.behind - eye.aside + room, WAKE_ASIDE * behind - across + (1.0 + WAKE_ASIDE) * aside, span);
    stone_keep(WAKE_ASIDE * eye.behind + eye.aside + room, WAKE_ASIDE * behind + across + (1.0 + WAKE_ASIDE) * aside, span);
    stone_keep(u_stone_form[i].z - eye.behind, aside - behind, span);
    return span.x > span.y ? -1.0 : max(eye.behind + (behind - aside) * (behind > aside ? span.x : span.y), 0.0);
}

// Column of the bounds for what lies so far behind the edge of a stone, m, and further: as far as bounds_join_pass.glsl counts from it.
int stone_kind(int i, float behind) {
    float away = behind * (1.0 + WAKE_ASIDE) / u_stone_form[i].x + 1.0;
    return away < float(WAKE_AWAY[1]) ? 0 : away < float(WAKE_AWAY[2]) ? 1 : away < float(WAKE_AWAY[3]) ? 2 : 3;
}

// @part bounds
// Bounds of the standing waves as their map holds them.
uniform sampler2D u_stone_bounds; // a row a stone; height (m), slope, second derivative (1/m) from WAKE_AWAY of its lengths on

vec3 stones_bounds(vec3 ray, float aside, float from) {
    vec3 sum = vec3(0.0);
    for (int i = 0; i < STONE_COUNT; ++i) {
        sum.xy += texel_at(u_stone_bounds, ivec2(0, i)).xy;
        float nearest = stone_nearest(i, ray, aside, from);
        sum.z += nearest < 0.0 ? 0.0 : texel_at(u_stone_bounds, ivec2(stone_kind(i, nearest), i)).z;
    }
    return sum;
}

// @part declared_bounds
// Bounds that stones alone state of their waves.
uniform float u_stone_highest; // m
uniform vec3 u_stone_bounds[STONE_COUNT]; // slope; second derivative near the stone, and elsewhere (1/m)

vec3 stones_bounds(vec3 ray, float aside, float from) {
    vec3 sum = vec3(u_stone_highest, 0.0, 0.0);
    for (int i = 0; i < STONE_COUNT; ++i) {
        vec3 bounds = u_stone_bounds[i];
        float nearest = stone_nearest(i, ray, aside, from);
        sum.y += bounds.x;
        sum.z += nearest < 0.0 ? 0.0 : nearest < (WAKE_NEAR + 1.0) * u_stone_form[i].x ? bounds.y : bounds.z;
    }
    return sum;
}

// @part gentler
// By how much less than surface_now() says a ray meets slopes, where it leaves out waves behind stones from `from` on.
uniform sampler2D u_stone_bounds; // a row a stone; height (m), slope, second derivative (1/m) from WAKE_AWAY of its lengths on

float stones_gentler(vec3 ray, float from) {
    float sum = 0.0;
    for (int i = 0; i < STONE_COUNT; ++i) {
        float nearest = stone_nearest(i, ray, 0.0, from);
        float slope = nearest < 0.0 ? 0.0 : texel_at(u_stone_bounds, ivec2(stone_kind(i, nearest), i)).y;
        // A thousandth less: the sum that it is taken from has been rounded.
        sum += max(0.999 * texel_at(u_stone_bounds, ivec2(0, i)).y - slope, 0.0);
    }
    return sum;
}
