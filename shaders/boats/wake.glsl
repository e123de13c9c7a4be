// A boat's wake: the pattern that the sampled course leaves, exact and from a map.

// @part way
// A place seen from a boat's course: how far behind its bow, along the circle, and how far to the side, outward.
struct WakeWay {
    float behind;    // m
    float aside;     // m
    vec2 on_behind;  // gradients along x and z
    vec2 on_aside;
};

WakeWay wake_way(int i, vec2 p) {
    vec4 course = u_boat_course[i];
    float radius = abs(course.w);
    float turn = course.w < 0.0 ? -1.0 : 1.0;
    vec2 from = p + course.xy;
    // At the centre there is no way round it; no wake reaches there.
    float far = max(length(from), 0.1 * radius);
    float angle = turn * (course.z - atan(from.y, from.x));
    // Three tenths of a radian lie before the boat, the rest of the circle behind it.
    angle = angle + 0.3 - TAU * floor((angle + 0.3) / TAU) - 0.3;
    return WakeWay(
        radius * angle + BOAT_STEM * u_boat_form[i].x, length(from) - radius,
        -turn * radius / (far * far) * vec2(-from.y, from.x), from / far);
}

// @part form
// What a wake is drawn from, wherever its boat is.
uniform vec4 u_wake[BOAT_COUNT];      // k (rad/m), height (m), length (m), shortest waves (rad/m)
uniform vec2 u_wake_boat[BOAT_COUNT]; // the boat's length and its circle's radius, m

// @part pattern
// Kelvin's wake (Thomson 1887) by stationary phase: behind a bow that moves at v stand two systems of waves, across and
// spreading, inside 19.5 degrees. With k = g / v^2 and t the tangent of a wave's heading, its phase is
// k sqrt(1 + t^2) (x - t z), where 2 z t^2 - x t + z = 0; its wavevector k sqrt(1 + t^2) (1, -t). Metres; exact to float32.

// The smoothstep and its derivative.
vec2 wake_step(float low, float high, float x) {
    float width = high - low;
    float u = clamp((x - low) / width, 0.0, 1.0);
    return vec2(u * u * (3.0 - 2.0 * u), 6.0 * u * (1.0 - u) / width);
}

// at: behind the bow and aside, aside >= 0 (m). wake: k (rad/m), height (m), length (m), shortest waves (rad/m).
// Returns height, its slopes behind and aside, and the mean square wavenumber.
vec4 wake_pattern(vec2 at, vec4 wake, float size, float radius) {
    float q = at.y / max(at.x, 1e-3);
    float square = 1.0 - 8.0 * q * q;
    if (at.x <= 0.0 || square <= 0.0 || at.x >= wake.z || wake.y <= 0.0) {
        return vec4(0.0);
    }
    float root = sqrt(square);
    float fall = TAU / (TAU + wake.x * at.x);
    vec2 t = vec2(2.0 * q / (1.0 + root), (1.0 + root) / (4.0 * max(q, 1e-4)));
    vec2 secant = sqrt(1.0 + t * t);
    vec2 k = wake.x * secant * secant;
    // At the edge of the wake both systems meet, and the phase has no second derivative: the wake opens from there.
    vec2 edge = wake_step(0.0, 0.5, square);
    vec2 begin = wake_step(0.0, 0.6 * size, at.x);
    vec2 end = wake_step(0.5 * wake.z, wake.z, at.x);
    vec2 side = wake_step(0.25 * radius, 0.4 * radius, at.y);
    float along = begin.x * (1.0 - end.x);
    float open = edge.x * along * (1.0 - side.x);
    // Waves much shorter than the hull is wide are not made; straight behind they would be endlessly short.
    vec2 a = wake.y * vec2(0.5 * sqrt(fall), pow(fall, 0.333333)) * exp(-min(k * k / (wake.w * wake.w), vec2(80.0)));
    // How the window, the fall and the shortest waves change with x, z and q.
    float bent = 8.0 * q / max(root, 1e-3);
    float on_q = -16.0 * q * edge.y * along * (1.0 - side.x);
    float on_x = edge.x * (begin.y * (1.0 - end.x) - begin.x * end.y) * (1.0 - side.x);
    float on_z = -edge.x * along * side.y;
    vec2 turn = vec2(2.0 / (1.0 + root) + 2.0 * q * bent / ((1.0 + root) * (1.0 + root)), -(bent * q + 1.0 + root) / (4.0 * max(q * q, 1e-8)));
    vec2 dull = -4.0 * wake.x / (wake.w * wake.w) * k * t * turn;
    vec2 a_q = a * (on_q + open * dull);
    vec2 a_x = a * (on_x - open * vec2(0.5, 0.333333) * fall * wake.x / TAU) - a_q * q / max(at.x, 1e-3);
    vec2 a_z = a * on_z + a_q / max(at.x, 1e-3);
    a *= open;
    vec2 phase = vec2(
        wrap_phase(wake.x * secant.x * (at.x - at.y * t.x)), wrap_phase(wake.x * secant.y * (at.x - at.y * t.y)));
    vec2 wave = cos(phase);
    vec2 rise = -a * sin(phase) * wake.x * secant;
    vec2 weight = a * a * k * k;
    return vec4(
        dot(a, wave), rise.x + rise.y + dot(a_x, wave), -dot(rise, t) + dot(a_z, wave),
        dot(weight, k * k) / max(weight.x + weight.y, 1e-12));
}

// @part waves
// What the wakes of boats add to the surface: heights over still water, slopes along x and z.

// Height, gradient, and the mean square wavenumber where slopes are.
vec4 wake_sum(vec2 p) {
    vec4 sum = vec4(0.0);
    float weight = 1e-12;
    for (int i = 0; i < BOAT_COUNT; ++i) {
        WakeWay way = wake_way(i, p);
        vec4 here = wake_here(i, vec2(way.behind, abs(way.aside)));
        vec2 slope = here.y * way.on_behind + (way.aside < 0.0 ? -here.z : here.z) * way.on_aside;
        float steep = dot(slope, slope);
        sum += vec4(here.x, slope, here.w * steep);
        weight += steep;
    }
    return vec4(sum.xyz, sum.w / weight);
}

vec3 wakes_waves(vec2 p) {
    return wake_sum(p).xyz;
}

// The same without what is smaller than the footprint, and the unresolved mean square slope.
vec4 wakes_shading(vec2 p, Footprint fp) {
    vec4 here = wake_sum(p);
    float kept = 1.0;
    if (SURFACE_FILTER) {
        kept = wave_kept(here.w, fp);
    }
    return vec4(kept * here.xyz, (1.0 - kept * kept) * dot(here.yz, here.yz));
}

// @part exact
// Wakes worked out at the place itself.
uniform vec4 u_wake[BOAT_COUNT]; // k (rad/m), height (m), length (m), shortest waves (rad/m)

vec4 wake_here(int i, vec2 at) {
    return wake_pattern(at, u_wake[i], u_boat_form[i].x, abs(u_boat_course[i].w));
}

// @part map
// Wakes read from the map that the frame drew: a band of rows a boat, along the course behind its bow and to one side.
uniform vec4 u_wake[BOAT_COUNT]; // k (rad/m), height (m), length (m), shortest waves (rad/m)
uniform sampler2D u_wake_map;

vec4 wake_here(int i, vec2 at) {
    vec2 share = vec2(at.x / max(u_wake[i].z, 1e-3), at.y / max(WAKE_ASIDE * u_wake[i].z, 1e-3));
    if (share.x <= 0.0 || share.x >= 1.0 || share.y >= 1.0) {
        return vec4(0.0);
    }
    float rows = float(WAKE_SIZE / 2);
    // Half a texel inside its band, so that no boat's wake shows in another's.
    float row = clamp(share.y * rows, 0.5, rows - 0.5) + rows * float(i);
    return textureLod(u_wake_map, vec2(share.x, row / (rows * float(BOAT_COUNT))), 0.0);
}

// @part map_pass
// The wakes of all boats, a band of rows each: height (m), slopes behind and aside, mean square wavenumber.
out vec4 o_wake;

void main() {
    int rows = WAKE_SIZE / 2;
    int i = as_int(floor(gl_FragCoord.y)) / rows;
    vec2 at = vec2(gl_FragCoord.x / float(WAKE_SIZE), (gl_FragCoord.y - float(i * rows)) / float(rows) * WAKE_ASIDE) * u_wake[i].z;
    o_wake = wake_pattern(at, u_wake[i], u_wake_boat[i].x, u_wake_boat[i].y);
}
