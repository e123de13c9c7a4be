// What a boat's wake never exceeds.

// @part declared
// Bounds that boats alone state of their wakes: the window at its bow bends a wake far more sharply than its waves do, and counts where a ray passes near it.
uniform float u_wake_highest; // m
uniform vec3 u_wake_bounds[BOAT_COUNT]; // slope; second derivative near the bow, and elsewhere (1/m)

// ray: from the eye, not normalised; aside: how far from it rays of its tile are, m a unit; from: where it begins.
vec3 wakes_bounds(vec3 ray, float aside, float from) {
    vec3 sum = vec3(u_wake_highest, 0.0, 0.0);
    for (int i = 0; i < BOAT_COUNT; ++i) {
        vec2 place = boat_place(i);
        float nearest = max(dot(place, ray.xz) / max(dot(ray.xz, ray.xz), 1e-12), from);
        float away = length(place - nearest * ray.xz) - nearest * aside;
        sum.yz += vec2(u_wake_bounds[i].x, away < WAKE_NEAR * u_boat_form[i].x ? u_wake_bounds[i].y : u_wake_bounds[i].z);
    }
    return sum;
}

// @part measured
// Bounds of the wakes as their map holds them: the window at its bow bends a wake far more sharply than its waves do, and counts
// where a ray passes near it.
uniform sampler2D u_wake_bounds; // a row a boat; height (m), slope, second derivative (1/m) from WAKE_AWAY of its lengths on

// ray: from the eye, not normalised; aside: how far from it rays of its tile are, m a unit; from: where it begins.
vec3 wakes_bounds(vec3 ray, float aside, float from) {
    vec3 sum = vec3(0.0);
    for (int i = 0; i < BOAT_COUNT; ++i) {
        vec2 place = boat_place(i);
        float nearest = max(dot(place, ray.xz) / max(dot(ray.xz, ray.xz), 1e-12), from);
        float away = (length(place - nearest * ray.xz) - nearest * aside) / u_boat_form[i].x;
        int kind = away < float(WAKE_AWAY[1]) ? 0 : away < float(WAKE_AWAY[2]) ? 1 : away < float(WAKE_AWAY[3]) ? 2 : 3;
        sum.xy += texel_at(u_wake_bounds, ivec2(0, i)).xy;
        sum.z += texel_at(u_wake_bounds, ivec2(kind, i)).z;
    }
    return sum;
}

// @part blocks
// What a wake's map holds at most in blocks of its texels: height (m), slope, second derivative where troughs turn up (1/m), as they
// lie on the water: inside the boat's circle the way behind it is drawn together. docs/formulae.md, section 3.
uniform sampler2D u_wake_map;
out vec4 o_bounds;

void main() {
    int rows = WAKE_SIZE / 2;
    ivec2 corner = as_int(floor(gl_FragCoord.xy)) * BOUNDS_BLOCK;
    int i = corner.y / rows;
    vec2 texel = u_wake[i].z * vec2(1.0 / float(WAKE_SIZE), WAKE_ASIDE / float(rows));
    float radius = u_wake_boat[i].y;
    vec3 bounds = vec3(0.0);
    for (int y = 0; y < BOUNDS_BLOCK; ++y) {
        int row = corner.y - i * rows + y;
        // No place is nearer to the centre than a tenth of the radius.
        float closer = radius / max(radius - float(row + 1) * texel.y, 0.1 * radius);
        for (int x = 0; x < BOUNDS_BLOCK; ++x) {
            ivec2 at = corner + ivec2(x, y);
            vec3 here = texelFetch(u_wake_map, at, 0).xyz;
            vec3 behind = texelFetch(u_wake_map, ivec2(min(at.x + 1, WAKE_SIZE - 1), at.y), 0).xyz;
            // Half a texel from the course each side is the other's mirror image; beyond the last row there is no wake.
            vec3 aside = row + 1 < rows ? texelFetch(u_wake_map, at + ivec2(0, 1), 0).xyz : vec3(0.0);
            vec3 along = (behind - here) / texel.x;
            vec3 across = (aside - here) / texel.y;
            float xx = along.y * closer * closer;
            float yy = across.z;
            float xy = 0.5 * (along.z + across.y) * closer;
            float bend = 0.5 * (xx + yy) + sqrt(0.25 * (xx - yy) * (xx - yy) + xy * xy);
            float steep = max(length(vec2(here.y * closer, here.z)), length(vec2(along.x * closer, across.x)));
            if (row == 0) {
                bend = max(bend, 2.0 * here.z / texel.y);
            }
            // On a circle straight ways turn against the course.
            bounds = max(bounds, vec3(here.x, steep, bend + 2.0 * closer * steep / radius));
        }
    }
    o_bounds = vec4(bounds, 0.0);
}

// @part join
// The greatest of a wake's blocks: a row a boat; a column for what lies so many of its lengths from its middle, and further.
uniform sampler2D u_wake_blocks;
out vec4 o_bounds;

void main() {
    ivec2 size = textureSize(u_wake_blocks, 0);
    int i = as_int(floor(gl_FragCoord.y));
    int rows = size.y / BOAT_COUNT;
    // On a wedge no wider than its way behind the bow a place is that way from it at least; the bow is within a length of the middle.
    float least = (float(WAKE_AWAY[as_int(floor(gl_FragCoord.x))]) - 1.0) * u_wake_boat[i].x / (1.0 + WAKE_ASIDE);
    int first = clamp(as_int(floor(least / u_wake[i].z * float(size.x))) - 1, 0, size.x);
    vec3 bounds = vec3(0.0);
    for (int y = i * rows; y < (i + 1) * rows; ++y) {
        for (int x = first; x < size.x; ++x) {
            bounds = max(bounds, texel_at(u_wake_blocks, ivec2(x, y)).xyz);
        }
    }
    // A little more: texels are read bilinearly, which at the bow they hardly resolve, and half floats are rounded.
    float bent = gl_FragCoord.x < 1.0 ? 2.0 : 1.2;
    o_bounds = vec4(min(vec3(1.01, 1.05, bent) * bounds, 65000.0), 0.0);
}
