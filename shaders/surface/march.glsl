// Where a ray meets the water: by marching, Newton's method, or a plane.

// @part ahead
// How far a march may go from a place that it has looked at, so that no crest stands over the ray between by more than the tolerance.
// gap: height over the surface there, m; rate: its change a unit of the ray; now: surface_now(); less: what slope and second derivative are
// less by there; bend: second derivative of the surface at most, 1/m.
float march_ahead(vec3 ray, float tau, float gap, float rate, float fine, vec3 now, vec2 less, float bend) {
    float speed = length(ray.xz);
    float fastest = max((now.x - less.x) * speed - ray.y, 1e-6 * length(ray));
    float curvature = (bend - less.y) * speed * speed;
    float sure = max(gap, 0.0) + fine * tau;
    float longest = safe_step(sure, u_surface_grain, rate, fastest, curvature);
    if (SHORT_WAVES) {
        // Over the short waves' highest crest only the long ones count.
        vec3 few = short_waves();
        float bends = curvature - now.z * speed * speed;
        longest = max(longest, safe_step(sure + few.x - now.y, u_surface_grain, rate + dot(few.yz, ray.xz), 1e30, bends));
    }
    return longest;
}

// @part begin
// Where a march along a ray from the eye may begin. docs/formulae.md, section 3.
// tau before which no ray of a tile of the picture meets: r + g the water's surface, b land over y = 0; a: second derivative of the
// surface at most (1/m), from 60000 on unknown.
uniform sampler2D u_start;
uniform float u_surface_trough; // no water is lower, m
uniform float u_surface_grain;  // what maps may add to the surface between their texels, m

// Of water, of land, and the second derivative. Outside the picture begins at 0 and nothing is known.
// ray: not normalised, 1 along the view.
vec3 march_start(vec3 ray) {
    vec2 clip = vec2(dot(ray, u_ray_x) / dot(u_ray_x, u_ray_x), dot(ray, u_ray_y) / dot(u_ray_y, u_ray_y));
    vec2 size = vec2(textureSize(u_start, 0));
    vec2 texel = clamp(floor((0.5 * clip + 0.5) * size), vec2(0.0), size - 1.0);
    vec4 start = textureLod(u_start, (texel + 0.5) / size, 0.0);
    float curvature = start.a < 60000.0 ? start.a : 1e9;
    return any(greaterThan(abs(clip), vec2(1.0))) ? vec3(0.0, 0.0, 1e9) : vec3(start.r + start.g, start.b, curvature);
}

// Gap over tau from which on Newton's method finishes a march: a share of a sample's height.
float march_tolerance() {
    return MARCH_TOLERANCE * length(u_ray_y) * 2.0 / u_viewport.y;
}

// @part step
// Longest step after which a ray cannot have passed the surface: it is `gap` (m, at least 0) away, the gap changes by `rate` a unit of
// the ray, closes by `fastest` at most, and its second derivative is at least -curvature: gap - grain + rate t - curvature t^2 / 2 >= 0.
// grain: what reading the surface from maps may add to that, m. docs/formulae.md, section 3.
float safe_step(float gap, float grain, float rate, float fastest, float curvature) {
    float sure = max(gap - grain, 0.0);
    float root = sqrt(rate * rate + 2.0 * curvature * sure);
    // Of the two forms of the root the one that does not cancel.
    float curved = rate < 0.0 ? 2.0 * sure / max(root - rate, 1e-20) : (sure > 0.0 ? (root + rate) / max(curvature, 1e-9) : 0.0);
    return max(gap / fastest, curved);
}

// @part march
// First hit of the ray with the surface by steps that cannot pass it, then Newton. A ray that passes close over a crest goes on
// where the surface falls away from it, so that no back of a crest shows.
// ray: from the eye, 1 along the view; returns tau < farthest, hit = eye + tau * ray. Exact to float32 where steps suffice (1 degree under the horizon).
uniform float u_surface_top;

const float FARTHEST = 1e5;

// By how much a step may pass a crest, over the first step: rays that brush crests would else take as many steps as all others.
float march_widened(int i) {
    return 1.0 + min(MARCH_STEP_WIDENS * float(i), MARCH_STEP_WIDEST);
}

bool find_surface(vec3 ray, float farthest, out float tau, out vec3 wave) {
    float speed = length(ray.xz);
    float reach = min(FARTHEST / max(speed, 1e-6 * length(ray)), farthest);
    float enter = 0.0;
    float leave = reach;
    float over = u_eye_height - u_surface_top;
    if (over > 0.0) {
        if (ray.y >= 0.0) {
            return false;
        }
        enter = over / -ray.y;
    } else if (ray.y > 0.0) {
        leave = min(leave, -over / ray.y);
    }
    if (ray.y < 0.0) {
        leave = max(u_eye_height - u_surface_trough, 0.0) / -ray.y;
    }
    leave = min(leave, reach);
    vec3 start = march_start(ray);
    enter = min(max(enter, start.r), leave);

    float fine = march_tolerance();
    vec3 now = surface_now();
    now.x -= surface_gentler(ray, enter);
    vec3 beyond = surface_beyond(ray, 0.0);
    tau = enter;
    march_open(ray, leave, fine, now, beyond.yz, start.b, tau);
    float gap = 0.0;
    // Looked at once before the loop: what the waves read from uniforms is then read there, not in every step.
    wave = waves(tau * ray.xz);
    for (int i = 0; i < MARCH_STEPS; ++i) {
        gap = u_eye_height + tau * ray.y - wave.x;
        float rate = ray.y - dot(wave.yz, ray.xz);
        if (tau >= leave || (gap < fine * tau && (gap < 0.0 || rate < 0.0))) {
            break;
        }
        tau += march_ahead(ray, tau, gap, rate, fine * march_widened(i), now, tau < beyond.x ? vec2(0.0) : beyond.yz, start.b);
        wave = waves(tau * ray.xz);
    }
    if ((ray.y >= 0.0 || tau >= farthest) && gap >= fine * tau) {
        return false;
    }
    refine_water(vec2(0.0), u_eye_height, ray, 1.0, fine, enter, REFINE, true, tau, gap, wave);
    return true;
}

// @part newton
// The mesh has found the surface; Newton steps along the ray finish. ray: not normalised; returns tau < farthest, hit = eye + tau * ray.
in vec3 v_position;

bool find_surface(vec3 ray, float farthest, out float tau, out vec3 wave) {
    vec3 to_mesh = v_position - vec3(0.0, u_eye_height, 0.0);
    tau = dot(to_mesh, ray) / dot(ray, ray);
    float limit = 0.05 * tau;
    // Waves too small to be told apart from here have no crest to hide behind: the same filter as the shading's.
    Footprint level = footprint(ray, tau, vec3(0.0, 1.0, 0.0));
    wave = waves_shading(tau * ray.xz, level).xyz;
    for (int i = 0; i < REFINE; ++i) {
        float gap = u_eye_height + tau * ray.y - wave.x;
        float rate = ray.y - dot(wave.yz, ray.xz);
        // Rising along the ray or parallel to it: no root to be found downhill.
        if (rate < -1e-3 * length(ray)) {
            tau -= clamp(gap / rate, -limit, limit);
            wave = waves_shading(tau * ray.xz, level).xyz;
        }
    }
    return tau > 0.0 && tau < farthest;
}

// @part plane
// Level water: where the ray meets y = 0, from above or below. ray: not normalised; returns tau < farthest, hit = eye + tau * ray.
const float FARTHEST = 1e5;

bool find_surface(vec3 ray, float farthest, out float tau, out vec3 wave) {
    wave = vec3(0.0);
    tau = 0.0;
    if (u_eye_height * ray.y >= 0.0) {
        return false;
    }
    tau = min(u_eye_height / -ray.y, FARTHEST / max(length(ray.xz), 1e-6 * length(ray)));
    return tau < farthest;
}
