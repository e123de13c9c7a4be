// A boat as it is drawn: its box, light, shadow and what is seen from over and under the water.

// @part vertex
// The rectangle of the picture that holds every boat's box, and three samples more for rays beside the middle ones. Drivers without
// branches would trace boats in every sample of the picture, to find none.
const float BOAT_NEAREST = 1e-2; // of a corner before the eye, m

void main() {
    vec2 squares = vec2(dot(u_ray_x, u_ray_x), dot(u_ray_y, u_ray_y));
    vec2 low = vec2(1.0);
    vec2 high = vec2(-1.0);
    for (int i = 0; i < BOAT_COUNT; ++i) {
        BoatFrame f = boat_frame(i);
        float size = u_boat_form[i].x;
        vec2 least = vec2(1e30);
        vec2 most = vec2(-1e30);
        float nearest = 1e30;
        float farthest = -1e30;
        for (int corner = 0; corner < 8; ++corner) {
            vec3 side = vec3(corner & 1, (corner >> 1) & 1, corner >> 2) * 2.0 - 1.0;
            vec3 local = size * (BOAT_BOX_MIDDLE + side * BOAT_BOX_HALF);
            vec3 place = f.at - vec3(0.0, u_eye_height, 0.0) + local.x * f.ahead + local.y * f.up + local.z * f.right;
            float depth = dot(place, u_ray_z);
            vec2 clip = vec2(dot(place, u_ray_x), dot(place, u_ray_y)) / (squares * max(depth, BOAT_NEAREST));
            least = min(least, clip);
            most = max(most, clip);
            nearest = min(nearest, depth);
            farthest = max(farthest, depth);
        }
        // A box that is partly behind the eye may show anywhere, one that is wholly behind it nowhere.
        bool shows = farthest > 0.0;
        bool anywhere = shows && nearest <= BOAT_NEAREST;
        low = anywhere ? vec2(-1.0) : shows ? min(low, least) : low;
        high = anywhere ? vec2(1.0) : shows ? max(high, most) : high;
    }
    vec2 pad = 6.0 / u_viewport;
    low = clamp(low - pad, -1.0, 1.0);
    high = max(clamp(high + pad, -1.0, 1.0), low);
    gl_Position = vec4(mix(low, high, greaterThan(quad_corner(), vec2(0.0))), FULLSCREEN_DEPTH, 1.0);
}

// @part met
// What a ray meets of a boat, in 31 bits: 12 for each side of the octahedron of normals in the boat's frame, 2 for the sunlight (0 behind a
// boat, 1 behind its sail, 2 none before it), 3 for the part, 2 for the boat. -1: none. Four rays take 8 registers, not 16 and more.
const int NO_BOAT = -1;

int met_code(int boat, int part, vec3 normal) {
    vec3 n = normal / (abs(normal.x) + abs(normal.y) + abs(normal.z));
    vec2 side = n.y < 0.0 ? (1.0 - abs(n.zx)) * mix(vec2(-1.0), vec2(1.0), greaterThanEqual(n.xz, vec2(0.0))) : n.xz;
    ivec2 q = as_int(floor(2047.0 * side + 2047.5));
    return (boat << 3 | part) << 26 | q.y << 12 | q.x;
}

vec3 met_normal(int code) {
    vec2 side = vec2(code & 4095, code >> 12 & 4095) / 2047.0 - 1.0;
    vec3 n = vec3(side.x, 1.0 - abs(side.x) - abs(side.y), side.y);
    n.xz -= max(-n.y, 0.0) * mix(vec2(-1.0), vec2(1.0), greaterThanEqual(n.xz, vec2(0.0)));
    return normalize(n);
}

int met_part(int code) {
    return code >> 26 & 7;
}

// Its reflectance, and share of a mirror's light. place: m from under the eye.
vec4 met_paint(int code, vec3 place) {
    int i = code >> 29;
    BoatFrame f = boat_frame(i);
    place -= f.at;
    vec3 at = vec3(dot(place, f.ahead), dot(place, f.up), dot(place, f.right)) / u_boat_form[i].x;
    return boat_albedo(met_part(code), at, met_normal(code), u_boat_rig[i].x > 0.5, u_boat_hull[i], u_boat_sails[i]);
}

// @part meet
// First boat on the ray o + t d, d a unit vector, and whether it is in the sun. Both rays in one loop, so that a program has one search for
// boats. known: what an earlier ray met; the same part is as much in the sun.
int meet_boat(vec3 o, vec3 d, bool dry, int known, out float t) {
    int code = NO_BOAT;
    vec3 from = o;
    vec3 way = d;
    for (int ray = 0; ray < 2; ++ray) {
        float far;
        BoatHit hit;
        int boat = trace_boats(from, way, 0.0, ray == 0 ? 1e5 : 1e4, ray == 0 && dry, far, hit);
        if (ray > 0) {
            code |= (boat < 0 ? 2 : hit.part == PART_SAIL ? 1 : 0) << 24;
            break;
        }
        t = far;
        code = boat < 0 ? NO_BOAT : met_code(boat, hit.part, hit.normal);
        bool alike = boat >= 0 && known >> 26 == code >> 26;
        code = alike ? code | (known & 3 << 24) : code;
        if (boat < 0 || alike) {
            break;
        }
        vec3 n = boat_normal(boat, hit.normal);
        float facing = dot(n, u_sun_direction);
        if (facing <= 0.0 && hit.part != PART_SAIL) {
            break;
        }
        from = boat_side(boat, o + far * d, n, facing);
        way = u_sun_direction;
    }
    return code;
}

// @part meet_dark
// The same without light.
int meet_boat(vec3 o, vec3 d, bool dry, int known, out float t) {
    BoatHit hit;
    int boat = trace_boats(o, d, 0.0, 1e5, dry, t, hit);
    return boat < 0 ? NO_BOAT : met_code(boat, hit.part, hit.normal);
}

// @part main
// A sample of a boat where it stands before water and land: BOAT_SIDE x BOAT_SIDE rays through it. Linear light, premultiplied.
out vec4 o_color;

const int BOAT_RAYS = BOAT_SIDE * BOAT_SIDE;

// The first BOAT_SIDE rays lie on a diagonal of the sample, in every row and column of its square.
vec3 boat_ray(int i) {
    int rest = max(i - BOAT_SIDE, 0);
    int row = rest / max(BOAT_SIDE - 1, 1);
    int column = rest % max(BOAT_SIDE - 1, 1);
    ivec2 at = i < BOAT_SIDE ? ivec2(i) : ivec2(column >= row ? column + 1 : column, row);
    return camera_ray(sample_place() + (vec2(at) + 0.5) / float(BOAT_SIDE) - 0.5);
}

// Where no ray can meet a boat, and then where none does, nothing more is asked: a discarded sample is the one branch that every driver takes.
void main() {
    if (!near_boats(camera_ray(sample_place()), length(u_ray_x) / u_viewport.x + length(u_ray_y) / u_viewport.y)) {
        discard;
    }
    vec3 eye = vec3(0.0, u_eye_height, 0.0);
    int met[BOAT_RAYS];
    float way[BOAT_RAYS];
    float farthest = 0.0;
    bool alike = BOAT_ALIKE;
    int known = NO_BOAT;
    // BOAT_ALIKE: where those on the diagonal meet one and the same, no upright or level edge is in the sample, and the others would too:
    // how many rays are traced ends a loop, which is the other branch that every driver takes.
    int count = BOAT_SIDE;
    for (int i = 0; i < count; ++i) {
        met[i] = meet_boat(eye, normalize(boat_ray(i)), false, BOAT_ALIKE ? known : NO_BOAT, way[i]);
        farthest = met[i] < 0 ? farthest : max(farthest, way[i]);
        alike = alike && (i == 0 || met[i] >> 26 == known >> 26);
        known = met[i];
        count = i == BOAT_SIDE - 1 && !alike ? BOAT_RAYS : count;
    }
    if (farthest == 0.0) {
        discard;
    }
    vec3 middle = 0.5 * (boat_ray(0) + boat_ray(BOAT_SIDE - 1));
    // A little further: the samples' other rays may meet the water before.
    boat_water(middle, 1.02 * farthest / length(middle));
    float shown = 0.0;
    for (int i = 0; i < count; ++i) {
        met[i] = met[i] >= 0 && boat_hidden(boat_ray(i), way[i]) ? NO_BOAT : met[i];
        shown += met[i] < 0 ? 0.0 : 1.0;
    }
    if (shown == 0.0) {
        discard;
    }
    // Those that meet the same part of the same boat have their own paint and the light of the first of them.
    vec4 sum = vec4(0.0);
    for (int i = 0; i < count; ++i) {
        int own = met[i];
        vec4 paint = vec4(0.0);
        float rays = 0.0;
        for (int j = i; own >= 0 && j < (BOAT_ALIKE ? count : i + 1); ++j) {
            if (met[j] >> 26 == own >> 26) {
                paint += met_paint(met[j], eye + way[j] * normalize(boat_ray(j)));
                rays += 1.0;
                met[j] = NO_BOAT;
            }
        }
        if (own >= 0) {
            vec3 d = normalize(boat_ray(i));
            vec3 seen = boat_light(own, paint / rays, eye + way[i] * d, d);
            sum += rays * vec4(min(exposure() * boat_before(seen, d, way[i]), BRIGHTEST), 1.0);
        }
    }
    o_color = sum / float(count);
}

// @part light
// A boat under sun and sky, with its own shadow. docs/formulae.md, section 15.
vec3 boat_in_air(vec3 light, vec3 d, float distance_to_eye) {
    return hazed(light, horizon_light(d), distance_to_eye);
}

// paint: reflectance, and share of a mirror's light; d: unit vector toward the place.
vec3 boat_light(int met, vec4 paint, vec3 place, vec3 d) {
    int i = met >> 29;
    vec3 n = boat_normal(i, met_normal(met));
    float facing = dot(n, u_sun_direction);
    float lit = max(facing, 0.0) + (met_part(met) == PART_SAIL ? 0.4 * max(-facing, 0.0) : 0.0);
    int sun = met >> 24 & 3;
    lit *= sun == 2 ? 1.0 : sun == 1 ? 0.25 : 0.0;
    if (lit > 0.0) {
        lit *= open_sun(boat_side(i, place, n, facing), Footprint(vec2(0.0), vec2(0.0)));
    }
    // From below comes what water mirrors of the light above.
    vec3 bounced = 0.1 * (u_sky_irradiance + u_sun_irradiance * max(u_sun_direction.y, 0.0)) * (0.5 - 0.5 * n.y);
    vec3 light = paint.rgb / PI * (u_sun_irradiance * lit + u_sky_irradiance * (0.5 + 0.5 * n.y) + bounced);
    vec3 r = reflect(d, n);
    vec3 mirrored = sky_light(vec3(r.x, abs(r.y), r.z)) * mix(0.25, 1.0, smoothstep(-0.1, 0.1, r.y));
    return light + paint.a * fresnel(clamp(-dot(n, d), 0.0, 1.0)) * (mirrored - light);
}

// @part dark
// No light: boats are black.
vec3 boat_in_air(vec3 light, vec3 d, float distance_to_eye) {
    return light;
}

vec3 boat_light(int met, vec4 paint, vec3 place, vec3 d) {
    return vec3(0.0);
}

// @part over
// What stands before a boat: water, or land. Water is looked for once a sample: as far as a sample is wide it is as good as a plane,
// where the sample's own ray meets it.
vec4 boat_plane = vec4(0.0); // normal . place is w, metres from the eye; no normal: no water before the boats

void boat_water(vec3 ray, float farthest) {
    float tau;
    vec3 wave;
    if (find_surface(ray, farthest, tau, wave)) {
        vec3 normal = vec3(-wave.y, 1.0, -wave.z);
        boat_plane = vec4(normal, dot(normal, tau * ray));
    }
}

bool boat_hidden(vec3 ray, float t) {
    float tau = t / length(ray);
    // On the far side of the plane from the eye; an eye on that side itself is under water, and sees none.
    bool under = boat_plane.y > 0.0 && (boat_plane.w >= 0.0 || tau * dot(boat_plane.xyz, ray) < boat_plane.w);
    return under || boat_behind_land(ray, tau);
}

vec3 boat_before(vec3 light, vec3 d, float t) {
    return boat_in_air(light, d, t);
}

// @part under
// An eye under the surface sees what of a boat is under it too, through the water between.
void boat_water(vec3 ray, float farthest) {
}

bool boat_hidden(vec3 ray, float t) {
    float tau;
    vec3 wave;
    return (find_underside(ray, tau, wave) && tau * length(ray) < t) || bed_reach(vec2(0.0), u_eye_height, normalize(ray)) < t;
}

vec3 boat_before(vec3 light, vec3 d, float t) {
    return light * exp(-below_extinction() * t) + below_glow(-u_eye_height, -d.y, t);
}

// @part land
// Whether land stands before a boat.
bool boat_behind_land(vec3 ray, float farthest) {
    float tau;
    vec4 ground;
    return find_land(ray, farthest, tau, ground);
}

// @part shadow
// The sun's light past boats: none under a hull, some through a sail. docs/formulae.md, section 15.
// place: m from under the eye, y over still water.
float sunlit(vec3 place, Footprint fp) {
    float t;
    BoatHit hit;
    if (trace_boats(place, u_sun_direction, 0.0, 1e4, false, t, hit) < 0) {
        return open_sun(place, fp);
    }
    return hit.part == PART_SAIL ? SUN_UNDER_SAIL * open_sun(place, fp) : 0.0;
}
