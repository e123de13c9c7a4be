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
    // Those that the ray can meet first: drivers that take no branch would work through all of them for every ray.
    int list[BOAT_COUNT];
    int count = 0;
    for (int i = 0; i < BOAT_COUNT; ++i) {
        if (meets_boat(boat_frame(i), u_boat_form[i].x, o, d, 0.0)) {
            list[count] = i;
            ++count;
        }
    }
    for (int n = 0; n < count; ++n) {
        int i = list[n];
        float size = u_boat_form[i].x;
        BoatFrame f = boat_frame(i);
        vec3 from = o - f.at;
        // From the place nearest to the boat on, so that no digit is lost to the way there.
        float nearest = dot(0.4 * size * f.up - from, d);
        vec3 start = from + nearest * d;
        vec3 local = vec3(dot(start, f.ahead), dot(start, f.up), dot(start, f.right)) / size;
        vec3 way = vec3(dot(d, f.ahead), dot(d, f.up), dot(d, f.right));
        float first = (least - nearest) / size;
        if (dry && way.y > 1e-6) {
            first = max(first, -local.y / way.y);
        }
        BoatHit one = BoatHit((t - nearest) / size, vec3(0.0, 1.0, 0.0), local, PART_HULL);
        float before = one.t;
        hit_boat(local, way, u_boat_rig[i].x > 0.5, u_boat_rig[i].yz, first, one);
        if (one.t < before && !(dry && one.at.y < -1e-4)) {
            found = i;
            t = nearest + one.t * size;
            hit = one;
        }
    }
    return found;
}
