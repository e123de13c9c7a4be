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
    vec3 at;
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
        hit = BoatHit(enter.w, normalize(enter.xyz), o + enter.w * d, part);
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
    hit = BoatHit(t, normalize(dot(normal, d) > 0.0 ? -normal : normal), o + t * d, PART_SAIL);
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

// Reflectance; gloss: share of a mirror's light.
vec3 boat_albedo(BoatHit hit, bool motor, vec3 paint, vec3 sails, out float gloss) {
    vec3 at = hit.at;
    gloss = 0.5;
    if (hit.part == PART_HULL) {
        if (at.y < 0.0) {
            return vec3(0.16, 0.03, 0.02);
        }
        bool strip = at.y < 0.012 || hull_sheer(motor, at.x) - at.y < 0.013;
        return strip ? vec3(0.75, 0.74, 0.7) : paint;
    }
    if (hit.part == PART_DECK) {
        gloss = 0.1;
        return motor ? vec3(0.16, 0.19, 0.17) : vec3(0.42, 0.3, 0.17);
    }
    if (hit.part == PART_HOUSE) {
        bool glass;
        if (motor) {
            bool pillar = abs(abs(at.z) - 0.028) < 0.004 || abs(at.x - 0.06) < 0.006
                || (abs(at.z) > 0.062 && (at.x > 0.12 || at.x < -0.012));
            glass = at.y > 0.25 && at.y < 0.315 && at.x > -0.017 && !pillar && hit.normal.y < 0.5;
        } else {
            glass = at.y > 0.1 && at.y < 0.122 && abs(fract(11.0 * at.x) - 0.5) < 0.3 && at.x > -0.16 && at.x < 0.11 && hit.normal.y < 0.7;
        }
        gloss = glass ? 1.0 : 0.3;
        return glass ? vec3(0.012, 0.014, 0.016) : motor ? sails : vec3(0.72, 0.71, 0.68);
    }
    gloss = hit.part == PART_SAIL ? 0.0 : 0.3;
    return hit.part == PART_SAIL ? sails : motor ? vec3(0.55, 0.2, 0.05) : vec3(0.5, 0.5, 0.48);
}
