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
