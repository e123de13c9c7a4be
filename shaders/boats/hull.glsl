// A boat's hull: its shape, its frame in the water, and where a ray meets it.

// @part frame
// A boat's axes as it floats now, and the box that holds it. Metres from the eye's own (x, z).
uniform sampler2DArray u_boat_pose;

const vec3 BOAT_BOX_MIDDLE = vec3(0.03, 0.5, 0.0); // ahead, up, right; boat lengths
const vec3 BOAT_BOX_HALF = vec3(0.56, 0.74, 0.5);

struct BoatFrame {
    vec3 at;
    vec3 ahead;
    vec3 up;
    vec3 right;
};

BoatFrame boat_frame(int i) {
    vec4 pose = texel_at(u_boat_pose, ivec3(i, 0, 0));
    vec4 ahead = texel_at(u_boat_pose, ivec3(i, 0, 1));
    vec3 up = texel_at(u_boat_pose, ivec3(i, 0, 2)).xyz;
    return BoatFrame(vec3(pose.w, pose.x, ahead.w), ahead.xyz, up, cross(ahead.xyz, up));
}

// @part hull
// Where a ray meets a boat, in closed form. Lengths in boat's lengths; x ahead, y up from the water line, z to starboard.
// Solids are cut out of the ray piece by piece: planes, and quadrics A t^2 + 2 B t + C <= 0. docs/formulae.md, section 15.
const int PART_HULL = 0;
const int PART_DECK = 1;
const int PART_HOUSE = 2;
const int PART_SPAR = 3;
const int PART_SAIL = 4;

struct BoatHit {
    float t;
    vec3 normal;
    int part;
};

// Half breadth amidships, its fall along and with depth, height of the greatest breadth, sheer's lowest, its rise.
const float HULL_MIDDLE = -0.12;
const float SHEER_LOWEST = -0.15;

void hull_form(bool motor, out float beam, out float fine, out float flare, out float widest, out float sheer, out float rise) {
    beam = motor ? 0.17 : 0.15;
    fine = beam / 0.3844;
    flare = motor ? 2.515 : 4.63;
    widest = motor ? 0.15 : 0.1;
    sheer = motor ? 0.12 : 0.085;
    rise = motor ? 0.26 : 0.1065;
}

float hull_sheer(bool motor, float x) {
    float along = x - SHEER_LOWEST;
    return motor ? 0.12 + 0.26 * along * along : 0.085 + 0.1065 * along * along;
}

// Roots of A t^2 + 2 B t + C, A >= 0; false where there are none.
bool quadric(float a, float b, float c, out vec2 roots) {
    // A ray along an axis has no square: the roots go far off, as they should.
    a = max(a, 1e-7);
    float square = b * b - a * c;
    if (square <= 0.0) {
        return false;
    }
    float q = -(b + (b < 0.0 ? -1.0 : 1.0) * sqrt(square));
    float one = q / a;
    float two = c / q;
    roots = vec2(min(one, two), max(one, two));
    return true;
}

// Keeps the part of the ray where dot(n, x) <= c. enter: normal and t.
void cut_plane(vec3 n, float c, vec3 o, vec3 d, inout vec4 enter, inout float leave) {
    float rate = dot(n, d);
    float over = dot(n, o) - c;
    if (abs(rate) < 1e-9) {
        leave = over > 0.0 ? -1e9 : leave;
        return;
    }
    float t = -over / rate;
    if (rate > 0.0) {
        leave = min(leave, t);
    } else if (t > enter.w) {
        enter = vec4(n, t);
    }
}

void take(vec4 enter, vec3 o, vec3 d, int part, inout BoatHit hit) {
    if (enter.w < hit.t) {
        hit = BoatHit(enter.w, normalize(enter.xyz), part);
    }
}

void hit_hull(vec3 o, vec3 d, bool motor, float least, inout BoatHit hit) {
    float beam, fine, flare, widest, sheer, rise;
    hull_form(motor, beam, fine, flare, widest, sheer, rise);
    vec4 enter = vec4(0.0, 1.0, 0.0, -1e9);
    float leave = 1e9;
    cut_plane(vec3(-1.0, -0.2, 0.0), 0.45, o, d, enter, leave);
    float x = o.x - HULL_MIDDLE;
    float y = o.y - widest;
    vec2 roots;
    for (int side = -1; side < 2; side += 2) {
        float s = float(side);
        // s z <= beam - fine x^2 - flare y^2
        if (!quadric(
                fine * d.x * d.x + flare * d.y * d.y,
                fine * x * d.x + flare * y * d.y + 0.5 * s * d.z,
                fine * x * x + flare * y * y + s * o.z - beam, roots)) {
            return;
        }
        if (roots.x > enter.w) {
            vec3 at = o + roots.x * d;
            enter = vec4(2.0 * fine * (at.x - HULL_MIDDLE), 2.0 * flare * (at.y - widest), s, roots.x);
        }
        leave = min(leave, roots.y);
    }
    // What stands over the sheer is cut away: y > sheer + rise (x - lowest)^2.
    float along = o.x - SHEER_LOWEST;
    if (quadric(rise * d.x * d.x, rise * along * d.x - 0.5 * d.y, rise * along * along + sheer - o.y, roots)) {
        if (enter.w < min(leave, roots.x) && min(leave, roots.x) > least) {
            take(vec4(enter.xyz, max(enter.w, least)), o, d, PART_HULL, hit);
            return;
        }
        if (roots.y > enter.w) {
            enter = vec4(-2.0 * rise * (o.x + roots.y * d.x - SHEER_LOWEST), 1.0, 0.0, roots.y);
            if (enter.w < leave && leave > least) {
                take(vec4(enter.xyz, max(enter.w, least)), o, d, PART_DECK, hit);
            }
            return;
        }
    }
    if (enter.w < leave && leave > least) {
        take(vec4(enter.xyz, max(enter.w, least)), o, d, PART_HULL, hit);
    }
}

// A house: level roof, walls that lean in by `lean`, a front that leans by `rake`.
void hit_house(vec3 o, vec3 d, vec4 box, float roof, float lean, float rake, float least, inout BoatHit hit) {
    vec4 enter = vec4(0.0, 1.0, 0.0, -1e9);
    float leave = 1e9;
    cut_plane(vec3(0.0, 1.0, 0.0), roof, o, d, enter, leave);
    cut_plane(vec3(0.0, -1.0, 0.0), -box.z, o, d, enter, leave);
    cut_plane(vec3(-1.0, 0.0, 0.0), -box.x, o, d, enter, leave);
    cut_plane(vec3(1.0, rake, 0.0), box.y + rake * box.z, o, d, enter, leave);
    cut_plane(vec3(0.0, lean, 1.0), box.w + lean * box.z, o, d, enter, leave);
    cut_plane(vec3(0.0, lean, -1.0), box.w + lean * box.z, o, d, enter, leave);
    if (enter.w < leave && leave > least) {
        take(vec4(enter.xyz, max(enter.w, least)), o, d, PART_HOUSE, hit);
    }
}

// A round spar from `foot` along the unit vector `way`.
void hit_spar(vec3 o, vec3 d, vec3 foot, vec3 way, float reach, float radius, float least, inout BoatHit hit) {
    vec3 from = o - foot;
    float along = dot(from, way);
    float rate = dot(d, way);
    vec3 a = d - rate * way;
    vec3 b = from - along * way;
    vec2 roots;
    if (!quadric(dot(a, a), dot(a, b), dot(b, b) - radius * radius, roots)) {
        return;
    }
    vec4 enter = vec4(b + roots.x * a, roots.x);
    float leave = roots.y;
    cut_plane(way, dot(way, foot) + reach, o, d, enter, leave);
    cut_plane(-way, -dot(way, foot), o, d, enter, leave);
    if (enter.w < leave && leave > least) {
        take(vec4(enter.xyz, max(enter.w, least)), o, d, PART_SPAR, hit);
    }
}

// A sail: a triangle whose edge from head to clew is rounded out, bellied to the light alone.
void hit_sail(vec3 o, vec3 d, vec3 tack, vec3 head, vec3 clew, float roach, float least, inout BoatHit hit) {
    vec3 luff = head - tack;
    vec3 foot = clew - tack;
    vec3 n = cross(luff, foot);
    float rate = dot(n, d);
    if (abs(rate) < 1e-9) {
        return;
    }
    float t = dot(n, tack - o) / rate;
    vec3 at = o + t * d - tack;
    float square = dot(n, n);
    float u = dot(cross(at, foot), n) / square;
    float v = dot(cross(luff, at), n) / square;
    // The rounded leech ends where u or v is 1; far beyond, its product would hold again.
    bool inside = min(u, v) >= 0.0 && max(u, v) <= 1.0 && u + v <= 1.0 + 4.0 * roach * u * v;
    if (t < least || t >= hit.t || !inside) {
        return;
    }
    float share = v / max(1.0 - u, 0.05);
    vec3 normal = normalize(n) + 0.5 * (2.0 * min(share, 1.0) - 0.8) * normalize(foot);
    hit = BoatHit(t, normalize(dot(normal, d) > 0.0 ? -normal : normal), PART_SAIL);
}

// Nearest hit with t >= least and before hit.t. rig: cosine and sine of the boom's angle.
void hit_boat(vec3 o, vec3 d, bool motor, vec2 rig, float least, inout BoatHit hit) {
    // One kind alone needs no branch.
    motor = BOAT_MOTORS && (motor || !BOAT_SAILS);
    hit_hull(o, d, motor, least, hit);
    if (motor) {
        hit_house(o, d, vec4(-0.02, 0.15, 0.1, 0.085), 0.34, 0.0, -0.15, least, hit);
        hit_house(o, d, vec4(-0.3, -0.1, 0.1, 0.07), 0.155, 0.3, 0.0, least, hit);
        hit_spar(o, d, vec3(0.02, 0.34, 0.0), vec3(0.0, 1.0, 0.0), 0.3, 0.007, least, hit);
        hit_spar(o, d, vec3(-0.36, 0.1, 0.0), vec3(0.0, 1.0, 0.0), 0.38, 0.009, least, hit);
        hit_spar(o, d, vec3(-0.36, 0.2, 0.0), vec3(0.8 * rig.x, 0.6, 0.8 * rig.y), 0.3, 0.006, least, hit);
        return;
    }
    hit_house(o, d, vec4(-0.2, 0.17, 0.08, 0.08), 0.14, 0.3, 1.2, least, hit);
    hit_spar(o, d, vec3(0.07, 0.08, 0.0), vec3(0.0, 1.0, 0.0), 1.06, 0.0075, least, hit);
    hit_spar(o, d, vec3(0.06, 0.19, 0.0), vec3(-rig.x, 0.0, rig.y), 0.45, 0.007, least, hit);
    hit_sail(o, d, vec3(0.06, 0.2, 0.0), vec3(0.06, 1.12, 0.0), vec3(0.06 - 0.44 * rig.x, 0.205, 0.44 * rig.y), 0.16, least, hit);
    hit_sail(o, d, vec3(0.47, 0.14, 0.0), vec3(0.085, 0.95, 0.0), vec3(0.1, 0.18, 0.22 * rig.y), -0.06, least, hit);
}

// Reflectance of a part of a boat, and its share of a mirror's light; normal: in the boat's frame, as is the place.
vec4 boat_albedo(int part, vec3 at, vec3 normal, bool motor, vec3 paint, vec3 sails) {
    if (part == PART_HULL) {
        bool strip = at.y < 0.012 || hull_sheer(motor, at.x) - at.y < 0.013;
        return vec4(at.y < 0.0 ? vec3(0.16, 0.03, 0.02) : strip ? vec3(0.75, 0.74, 0.7) : paint, 0.5);
    }
    if (part == PART_DECK) {
        return vec4(motor ? vec3(0.16, 0.19, 0.17) : vec3(0.42, 0.3, 0.17), 0.1);
    }
    if (part == PART_HOUSE) {
        bool glass;
        if (motor) {
            bool pillar = abs(abs(at.z) - 0.028) < 0.004 || abs(at.x - 0.06) < 0.006
                || (abs(at.z) > 0.062 && (at.x > 0.12 || at.x < -0.012));
            glass = at.y > 0.25 && at.y < 0.315 && at.x > -0.017 && !pillar && normal.y < 0.5;
        } else {
            glass = at.y > 0.1 && at.y < 0.122 && abs(fract(11.0 * at.x) - 0.5) < 0.3 && at.x > -0.16 && at.x < 0.11 && normal.y < 0.7;
        }
        return glass ? vec4(0.012, 0.014, 0.016, 1.0) : vec4(motor ? sails : vec3(0.72, 0.71, 0.68), 0.3);
    }
    return part == PART_SAIL ? vec4(sails, 0.0) : vec4(motor ? vec3(0.55, 0.2, 0.05) : vec3(0.5, 0.5, 0.48), 0.3);
}

// @part trace
// Rays against all boats as they float now. Metres from the eye's own (x, z).
uniform vec3 u_boat_rig[BOAT_COUNT];   // 1 for a motor boat, cosine and sine of the boom's angle
uniform vec3 u_boat_hull[BOAT_COUNT];  // reflectance
uniform vec3 u_boat_sails[BOAT_COUNT];

// Whether a ray o + t d with t >= 0, d a unit vector, meets the box that holds a boat, which is `spread` wider for every length of way.
bool meets_boat(BoatFrame f, float size, vec3 o, vec3 d, float spread) {
    vec3 from = o - f.at;
    vec3 local = vec3(dot(from, f.ahead), dot(from, f.up), dot(from, f.right)) / size;
    vec3 way = vec3(dot(d, f.ahead), dot(d, f.up), dot(d, f.right));
    vec3 half_box = BOAT_BOX_HALF + spread * (length(local) + 1.3);
    // A ray along a side of the box: so slow across it that it stays.
    vec3 over = 1.0 / mix(way, vec3(1e-6), lessThan(abs(way), vec3(1e-6)));
    vec3 one = (BOAT_BOX_MIDDLE - half_box - local) * over;
    vec3 two = (BOAT_BOX_MIDDLE + half_box - local) * over;
    vec3 enter = min(one, two);
    vec3 leave = max(one, two);
    return max(max(enter.x, enter.y), max(enter.z, 0.0)) <= min(min(leave.x, leave.y), leave.z);
}

// Whether a ray from the eye, or one up to `aside` of it a unit, can meet a boat; ray: not normalised.
bool near_boats(vec3 ray, float aside) {
    float size = length(ray);
    bool found = false;
    for (int i = 0; i < BOAT_COUNT; ++i) {
        found = found || meets_boat(boat_frame(i), u_boat_form[i].x, vec3(0.0, u_eye_height, 0.0), ray / size, aside / size);
    }
    return found;
}

// First boat on the ray o + t d, d a unit vector, from `least` on and before `farthest` (m): which, and where; -1: none.
// dry: what is under the water line does not count.
int trace_boats(vec3 o, vec3 d, float least, float farthest, bool dry, out float t, out BoatHit hit) {
    int found = -1;
    t = farthest;
    hit = BoatHit(farthest, vec3(0.0, 1.0, 0.0), PART_HULL);
    // Those that the ray can meet first: drivers that take no branch would work through all of them for every ray.
    // Their numbers are the digits of `list`.
    int list = 0;
    for (int i = BOAT_COUNT - 1; i >= 0; --i) {
        if (meets_boat(boat_frame(i), u_boat_form[i].x, o, d, 0.0)) {
            list = list << 4 | (i + 1);
        }
    }
    while (list > 0) {
        int i = (list & 15) - 1;
        list >>= 4;
        float size = u_boat_form[i].x;
        BoatFrame f = boat_frame(i);
        vec3 from = o - f.at;
        // From the place nearest to the boat on, so that no digit is lost to the way there.
        float nearest = dot(0.4 * size * f.up - from, d);
        vec3 start = from + nearest * d;
        vec3 local = vec3(dot(start, f.ahead), dot(start, f.up), dot(start, f.right)) / size;
        vec3 way = vec3(dot(d, f.ahead), dot(d, f.up), dot(d, f.right));
        float first = (least - nearest) / size;
        // What is under the water line counts neither before a ray that rises leaves it, nor after one that falls meets it.
        float line = -local.y / way.y;
        float before = (t - nearest) / size;
        first = dry && way.y > 1e-6 ? max(first, line) : first;
        before = dry && way.y < -1e-6 ? min(before, line) : before;
        hit.t = before;
        hit_boat(local, way, u_boat_rig[i].x > 0.5, u_boat_rig[i].yz, first, hit);
        if (hit.t < before) {
            found = i;
            t = nearest + hit.t * size;
        }
    }
    return found;
}

// Of a normal in a boat's frame, the world's.
vec3 boat_normal(int i, vec3 normal) {
    BoatFrame f = boat_frame(i);
    return normal.x * f.ahead + normal.y * f.up + normal.z * f.right;
}

// A place of a boat, off its surface on the sun's side, so that nothing shades itself. facing: cosine between normal and sun.
vec3 boat_side(int i, vec3 place, vec3 n, float facing) {
    return place + 3e-3 * u_boat_form[i].x * (facing < 0.0 ? -n : n);
}
