// Stones that stand over a current: shape, look, light, shadow and mirror image. docs/formulae.md, section 16.

// @part shape
// A stone: a dome on an upright drum, cut by planes. All together are a norm of the order 8, so the stone is convex and its edges are round,
// and Newton's method from outside comes to a ray's first place on it without passing it. Metres from under the eye.
uniform vec4 u_boulder_place[BOULDER_COUNT];               // from the stone to the eye x, z; radius; height of the dome
uniform vec3 u_boulder_cuts[BOULDER_COUNT * 8]; // planes m.x = 1, x in radii; and last its place in the noise, cells
uniform vec3 u_boulder_foot;                               // lowest water, highest water, lowest ground

// Of a place x radii from a stone's middle: the norm to the eighth, w, and its gradient.
vec4 boulder_norm(int i, vec3 x) {
    vec3 dome = vec3(1.0, x.y > 0.0 ? BOULDER_REACH * u_boulder_place[i].z / u_boulder_place[i].w : 0.0, 1.0) / BOULDER_REACH;
    vec3 s = dome * x;
    float square = dot(s, s);
    vec4 sum = square * square * square * vec4(8.0 * dome * s, square);
    for (int k = 0; k < 7; ++k) {
        vec3 cut = u_boulder_cuts[8 * i + k];
        float e = max(dot(cut, x), 0.0);
        sum += e * e * e * e * e * e * e * vec4(8.0 * cut, e);
    }
    return sum;
}

// Height from which on a stone can be seen.
float boulder_foot() {
    return u_eye_height > u_boulder_foot.y ? u_boulder_foot.x : u_boulder_foot.z;
}

// Where a ray from + t d, in radii, is in the box of a stone that is `spread` wider for every length of way.
vec2 boulder_span(int i, vec3 from, vec3 d, float spread) {
    vec4 of = u_boulder_place[i];
    vec3 pad = vec3(spread * (length(from) + 2.0));
    vec3 low = vec3(-BOULDER_REACH, boulder_foot() / of.z, -BOULDER_REACH) - pad;
    vec3 high = vec3(BOULDER_REACH, of.w / of.z, BOULDER_REACH) + pad;
    vec3 over = 1.0 / mix(d, vec3(1e-6), lessThan(abs(d), vec3(1e-6)));
    vec3 one = (low - from) * over;
    vec3 two = (high - from) * over;
    vec3 enter = min(one, two);
    vec3 leave = max(one, two);
    return vec2(max(max(enter.x, enter.y), max(enter.z, 0.0)), min(min(leave.x, leave.y), leave.z));
}

const float BOULDER_WET = 0.3;   // reflectance of wet rock in that of the land's
const float BOULDER_LIKE = 0.9;  // size of the ellipsoid that throws a stone's shadow, in that of its dome
const int BOULDER_STEPS = 8;

vec3 boulder_at(int i, vec3 place) {
    return (place + vec3(u_boulder_place[i].x, 0.0, u_boulder_place[i].y)) / u_boulder_place[i].z;
}

// @part veil
// How much of a ray from a place a stone takes, told by the ellipsoid that is most like it.
// blur: how far the ray is spread, rad.
float boulder_veil(int i, vec3 place, vec3 d, float blur) {
    vec4 of = u_boulder_place[i];
    vec3 axes = BOULDER_LIKE * vec3(of.z, of.w, of.z);
    vec3 from = (place + vec3(of.x, 0.0, of.y)) / axes;
    vec3 way = d / axes;
    float square = dot(way, way);
    float along = max(-dot(from, way), 0.0) / square;
    float edge = 0.12 + blur * along / axes.x;
    float miss = length(from + along * way);
    float taken = (1.0 - smoothstep(1.0 - edge, 1.0 + edge, miss)) / max(edge * edge, 1.0);
    // What faces the ray's end is before the stone.
    return taken * smoothstep(0.0, 0.5, along * sqrt(square));
}

// @part sunlit
// The sun's light past stones. place: m from under the eye, y over still water.
float boulder_sunlit(vec3 place, Footprint fp) {
    float left = 1.0;
    for (int i = 0; i < BOULDER_COUNT; ++i) {
        left *= 1.0 - boulder_veil(i, place, u_sun_direction, 0.005);
    }
    return left;
}

// @part mirrored
// The water mirrors stones: wet rock under sun and sky on the side that a ray comes to. r: unit vector.
uniform vec3 u_boulder_rock;

vec3 reflected_light(vec3 place, vec3 r, vec3 spread) {
    vec3 light = mirrored_sky(r, spread);
    float facing = max(-dot(r.xz, u_sun_direction.xz), 0.0);
    vec3 rock = BOULDER_WET / PI * u_boulder_rock * (0.5 * u_sky_irradiance + facing * u_sun_irradiance);
    for (int i = 0; i < BOULDER_COUNT; ++i) {
        light = mix(light, rock, boulder_veil(i, place, r, spread.x));
    }
    return light;
}

// @part vertex
// Rectangles of the picture that hold the boxes of stones, and three samples more for rays beside the middle ones: one rectangle where they
// overlap, so that no sample is drawn twice. Drivers without branches would trace stones in every sample of the picture, to find none.
const float BOULDER_NEAREST = 1e-2; // of a corner before the eye, m
const vec4 BOULDER_NOWHERE = vec4(2.0);

vec4 boulder_box(int i) {
    vec4 of = u_boulder_place[i];
    vec2 squares = vec2(dot(u_ray_x, u_ray_x), dot(u_ray_y, u_ray_y));
    vec4 box = vec4(1e30, 1e30, -1e30, -1e30);
    float nearest = 1e30;
    float farthest = -1e30;
    // Of the water around, no place is farther than 0.7 radii from one of these, and there it is not steeper than 0.5.
    float low = waves(-of.xy).x;
    for (int k = 0; k < 8; ++k) {
        float turn = TAU * float(k) / 8.0;
        low = min(low, waves(0.9 * of.z * vec2(cos(turn), sin(turn)) - of.xy).x);
    }
    float foot = max(boulder_foot(), u_eye_height > u_boulder_foot.y ? low - 0.35 * of.z - 0.02 : -1e9);
    for (int corner = 0; corner < 8; ++corner) {
        vec2 side = BOULDER_REACH * of.z * (vec2(corner & 1, corner >> 1 & 1) * 2.0 - 1.0) - of.xy;
        vec3 place = vec3(side.x, (corner < 4 ? of.w : foot) - u_eye_height, side.y);
        float depth = dot(place, u_ray_z);
        vec2 clip = vec2(dot(place, u_ray_x), dot(place, u_ray_y)) / (squares * max(depth, BOULDER_NEAREST));
        box = vec4(min(box.xy, clip), max(box.zw, clip));
        nearest = min(nearest, depth);
        farthest = max(farthest, depth);
    }
    vec4 pad = vec4(-1.0, -1.0, 1.0, 1.0) * 6.0 / u_viewport.xyxy;
    // A box that is partly behind the eye may show anywhere, one that is wholly behind it nowhere.
    box = nearest <= BOULDER_NEAREST ? vec4(-1.0, -1.0, 1.0, 1.0) : clamp(box + pad, -1.0, 1.0);
    return farthest <= 0.0 ? BOULDER_NOWHERE : box;
}

void main() {
    vec4 box[BOULDER_COUNT];
    for (int i = 0; i < BOULDER_COUNT; ++i) {
        box[i] = boulder_box(i);
    }
    for (int again = 1; again < BOULDER_COUNT; ++again) {
        for (int i = 1; i < BOULDER_COUNT; ++i) {
            for (int j = 0; j < i; ++j) {
                if (all(lessThan(box[i].xy, box[j].zw)) && all(lessThan(box[j].xy, box[i].zw))) {
                    box[j] = vec4(min(box[i].xy, box[j].xy), max(box[i].zw, box[j].zw));
                    box[i] = BOULDER_NOWHERE;
                }
            }
        }
    }
    vec4 own = box[gl_VertexID / 6];
    gl_Position = vec4(mix(own.xy, own.zw, greaterThan(quad_corner(), vec2(0.0))), FULLSCREEN_DEPTH, 1.0);
}

// @part meet
// Where rays meet stones.
const int NO_BOULDER = -1;

// Whether a ray from the eye, or one up to `aside` of it a unit, can meet a stone; ray: not normalised.
bool near_boulder(vec3 ray, float aside) {
    float size = length(ray);
    bool found = false;
    for (int i = 0; i < BOULDER_COUNT; ++i) {
        vec2 span = boulder_span(i, boulder_at(i, vec3(0.0, u_eye_height, 0.0)), ray / size, aside / size);
        found = found || span.x <= span.y;
    }
    return found;
}

// Way to a stone along a ray o + t d, d a unit vector, m; -1: it meets none.
float boulder_way(int i, vec3 o, vec3 d) {
    vec3 from = boulder_at(i, o);
    vec2 span = boulder_span(i, from, d, 0.0);
    float t = span.x;
    float norm = 2.0;
    for (int k = 0; k < BOULDER_STEPS && t <= span.y; ++k) {
        vec4 sum = boulder_norm(i, from + t * d);
        norm = sum.w;
        float rate = dot(sum.xyz, d);
        if (norm <= 1.0001) {
            break;
        }
        // Convex: where the norm grows, the ray has passed the stone.
        t += rate < 0.0 ? 8.0 * norm * (inversesqrt(sqrt(sqrt(norm))) - 1.0) / rate : 1e9;
    }
    return t <= span.y && norm <= 1.01 ? t * u_boulder_place[i].z : -1.0;
}

// First stone on the ray o + t d, its number at bits 26 and up. dry, known: a boat's.
int meet_boulder(vec3 o, vec3 d, bool dry, int known, out float t) {
    int met = NO_BOULDER;
    t = 1e5;
    for (int i = 0; i < BOULDER_COUNT; ++i) {
        float way = boulder_way(i, o, d);
        if (way >= 0.0 && way < t) {
            t = way;
            met = i << 26;
        }
    }
    return met;
}

// All of its look is its light's.
vec4 met_paint(int met, vec3 place) {
    return vec4(0.0);
}

// @part light
// A stone's look and its light: rock with pits and cracks, as the land's; dark and wet up to where water runs over it, where its film mirrors.
uniform vec3 u_boulder_rock;
uniform float u_boulder_wet; // height over still water that is all wet, m

const uint BOULDER_KEY = 0x51ED270Bu;
const float BOULDER_CELL = 1.9; // of the first octave, m
// Of each octave: share of the pattern, and height of the relief over its cell.
const vec2 BOULDER_OCTAVES[4] = vec2[4](vec2(0.62, 0.05), vec2(0.52, 0.07), vec2(0.44, 0.07), vec2(0.38, 0.06));

vec3 boulder_in_air(vec3 light, vec3 d, float distance_to_eye) {
    return hazed(light, horizon_light(d), distance_to_eye);
}

// paint: not used; d: unit vector toward the place, m from under the eye.
vec3 boulder_light(int met, vec4 paint, vec3 place, vec3 d) {
    int i = met >> 26;
    vec3 x = boulder_at(i, place);
    vec3 n = normalize(boulder_norm(i, x).xyz);
    float depth = dot(place - vec3(0.0, u_eye_height, 0.0), u_ray_z);
    float width = depth * 2.0 * length(u_ray_y) / u_viewport.y / max(-dot(n, d), 0.3);
    float pattern = 0.0;
    float broad = 0.0;
    float ragged = 0.0;
    float cracks = 0.0;
    vec3 relief = vec3(0.0);
    float cell = BOULDER_CELL;
    for (int k = 0; k < 4; ++k) {
        float kept = 1.0 - smoothstep(0.15, 0.6, width / cell);
        vec4 m = noise_slopes_3(x * u_boulder_place[i].z / cell + u_boulder_cuts[8 * i + 7], BOULDER_KEY + uint(k));
        pattern += BOULDER_OCTAVES[k].x * kept * m.w;
        broad += k < 2 ? kept * m.w : 0.0;
        ragged += k > 0 ? kept * m.w : 0.0;
        float gap = max(1.0 - 5.0 * abs(m.w), 0.0);
        cracks += k == 1 || k == 2 ? mix(0.0575, gap * gap, kept) : 0.0;
        relief -= BOULDER_OCTAVES[k].y * kept * m.w * inversesqrt(m.w * m.w + 0.04) * m.xyz;
        cell *= 0.31;
    }
    relief -= dot(relief, n) * n;
    vec3 rough = normalize(n - relief);
    vec3 level = normalize(n - 0.6 * relief);
    vec3 rock = u_boulder_rock * max(1.0 + 0.3 * pattern, 0.2) * (1.0 - 0.35 * min(cracks, 1.0));
    rock *= mix(vec3(1.0), vec3(1.12, 1.0, 0.86), clamp(0.5 * broad, -1.0, 1.0));
    float wet = 1.0 - smoothstep(u_boulder_wet, 2.0 * u_boulder_wet, place.y - 0.3 * u_boulder_wet * ragged);
    rock *= mix(1.25, BOULDER_WET, wet);
    // No film under water; and what mirrors downward mirrors dark water.
    float film = smoothstep(-u_boulder_wet, 0.0, place.y) * wet * mix(0.1, 0.8, smoothstep(0.8, 1.0, dot(rough, n)));
    film *= mix(0.25, 1.0, smoothstep(-0.1, 0.1, reflect(d, level).y));
    float sun = dot(n, u_sun_direction) > 0.0 ? open_sun(place, Footprint(vec2(0.0), vec2(0.0))) : 0.0;
    return land_light(d, level, Soil(rough, min(rock, 0.95), film), sun);
}

// @part drowned
// Rock that is seen from under water: its film mirrors nothing.
vec3 land_light(vec3 d, vec3 level, Soil soil, float sun) {
    return soil.albedo / PI * irradiance_past(soil.normal, sun);
}

// @part over_met
// What stands before a stone where a pass has found what the samples of the picture meet, water or land: nothing is looked for again. Between
// four of these samples the inverse of the way to a plane is linear in the picture.
uniform sampler2D u_met; // tau, and what is there: 0 nothing

vec2 boulder_middle = vec2(0.0);  // in texels
vec3 boulder_plane = vec3(0.0);   // there, 1 / tau, and its change from texel to texel

vec2 boulder_texel(vec3 ray) {
    vec2 clip = vec2(dot(ray, u_ray_x) / dot(u_ray_x, u_ray_x), dot(ray, u_ray_y) / dot(u_ray_y, u_ray_y));
    return (0.5 * clip + 0.5) * vec2(textureSize(u_met, 0)) - 0.5;
}

float boulder_met(int column, int row) {
    vec2 met = texel_at(u_met, clamp(ivec2(column, row), ivec2(0), textureSize(u_met, 0) - 1)).rg;
    return met.g > 0.0 ? 1.0 / max(met.r, 1e-6) : 0.0;
}

void boulder_water(vec3 ray, float farthest) {
    boulder_middle = boulder_texel(ray);
    int low = as_int(floor(boulder_middle.y));
    float up = boulder_middle.y - float(low);
    vec4 near;
    vec2 across;
    for (int j = 0; j < 2; ++j) {
        int row = low + j;
        float column = boulder_middle.x - (BOULDER_SHIFTED ? (row & 1) == 0 ? -ROW_SHIFT : ROW_SHIFT : 0.0);
        int left = as_int(floor(column));
        vec2 pair = vec2(boulder_met(left, row), boulder_met(left + 1, row));
        across[j] = column - float(left);
        near = j == 0 ? vec4(pair, 0.0, 0.0) : vec4(near.xy, pair);
    }
    vec2 rows = mix(near.xz, near.yw, across);
    boulder_plane = vec3(mix(rows.x, rows.y, up), mix(near.y - near.x, near.w - near.z, up), rows.y - rows.x);
    float least = min(min(near.x, near.y), min(near.z, near.w));
    float most = max(max(near.x, near.y), max(near.z, near.w));
    if (least < 0.8 * most) {
        // An edge of land or of a crest lies between them: that of the nearest.
        vec2 row = up < 0.5 ? near.xy : near.zw;
        boulder_plane = vec3((up < 0.5 ? across.x : across.y) < 0.5 ? row.x : row.y, 0.0, 0.0);
    }
}

bool boulder_hidden(vec3 ray, float t) {
    return t * (boulder_plane.x + dot(boulder_plane.yz, boulder_texel(ray) - boulder_middle)) > length(ray);
}

vec3 boulder_before(vec3 light, vec3 d, float t) {
    return boulder_in_air(light, d, t);
}
