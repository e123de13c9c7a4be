// Rays to land and sea floor. A ray: q + tau ray.xz, metres from the middle of the square; height + tau ray.y, over y = 0.
// docs/formulae.md, sections 8 and 10.

// Where a ray is inside the square and between y = 0 and the highest land: from x to y; nowhere, where y is not more than x.
vec2 land_span(vec2 q, float height, vec3 ray) {
    vec2 span = shore_span(q, ray.xz);
    float enter = span.x;
    float leave = span.y;
    float over = height - u_shore_top;
    float fall = abs(ray.y) < 1e-9 ? -1e-9 : ray.y;
    // A rising ray leaves through the top, a falling one enters there and leaves at y = 0, where the sea begins.
    if (over > 0.0) {
        enter = max(enter, ray.y < 0.0 ? over / -fall : 1e30);
    } else if (ray.y > 0.0) {
        leave = min(leave, -over / fall);
    }
    if (ray.y < 0.0) {
        leave = min(leave, height / -fall);
    }
    return vec2(enter, leave);
}

// Steps that cannot pass the ground, until the ray is less than fine (near + tau) over it or past `leave`. before: the last place but one;
// gap: height over the ground, which is met there.
// dry: only land over y = 0 counts, and a ray that brushes a ridge does not spend all its steps there: with the last half it goes on to
// `leave`.
void march_ground(
    vec2 q, float height, vec3 ray, float leave, float fine, float near, bool dry,
    inout float tau, out float before, out float gap, out vec4 ground) {
    float level = length(ray.xz);
    float slowest = 1e-6 * length(ray);
    float fastest = max(u_shore_steepest[0] * level - ray.y, slowest);
    float fastest_dry = max(u_shore_steepest[1] * level - ray.y, slowest);
    before = tau;
    gap = 0.0;
    for (int i = 0; i < MARCH_STEPS; ++i) {
        ground = shore_floor(q + tau * ray.xz);
        gap = height + tau * ray.y - ground.x;
        if (gap < fine * (near + tau) || tau >= leave) {
            break;
        }
        before = tau;
        tau += gap / fastest;
        if (dry) {
            // Land over y = 0 is gentler than the floor, and lower than the ray by no more than the ray's own height.
            tau = max(tau, before + min(gap, height + before * ray.y) / fastest_dry);
            float rate = ray.y - dot(ground.yz, ray.xz);
            tau = max(tau, before + safe_step(gap, 0.0, rate, 1e30, u_shore_bend * level * level));
        }
        if (dry && 2 * i >= MARCH_STEPS) {
            tau = max(tau, before + (leave - before) / float(MARCH_STEPS - i));
        }
    }
}
