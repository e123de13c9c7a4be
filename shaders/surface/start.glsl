// How far beams of rays are free of water.

// @part start
// A march of the pyramid of rays between ray - side - top and ray + side + top to the water's surface, from the side that the eye
// is on: no step that any of the rays could not take. docs/formulae.md, section 3.
uniform float u_surface_trough; // no water is lower, m
uniform float u_surface_grain;  // what maps may add to the surface between their texels, m

vec3 water_start(vec3 ray, vec3 side, vec3 top) {
    Pyramid rays = pyramid(ray, side, top);
    vec3 bounds = surface_bounds(ray, rays.aside, 0.0);
    vec3 beyond = surface_beyond(ray, rays.aside);
    float sense = 1.0;
    float toward = 0.0;
    float tau = 0.0;
    // First under the eye, so that programs hold the waves once: which side of them it is on.
    for (int i = -1; i < MARCH_STEPS; ++i) {
        if (tau >= rays.reach) {
            break;
        }
        vec3 wave = waves(tau * ray.xz);
        if (i < 0) {
            sense = u_eye_height < wave.x ? -1.0 : 1.0;
            // The ray that comes toward the surface the fastest.
            toward = rays.raised - sense * ray.y;
            float over = sense > 0.0 ? u_eye_height - bounds.x : u_surface_trough - u_eye_height;
            tau = max(pyramid_enters(rays, over, toward), pyramid_free.x);
            continue;
        }
        float gap = sense * (u_eye_height + tau * ray.y - wave.x);
        float rate = sense * (ray.y - dot(wave.yz, ray.xz));
        vec2 less = tau < beyond.x ? vec2(0.0) : beyond.yz;
        float steepest = bounds.y - less.x;
        float fastest = max(steepest * rays.speed + toward, 1e-6 * length(ray));
        // Crests are sharper than troughs: from below only slopes are told.
        float curvature = sense > 0.0 && bounds.z < 60000.0 ? bounds.z - less.y : 1e9;
        // As near as any ray of the pyramid can be: by the steepest slope, and by the slope here and the curvature.
        float sloped = gap - tau * (rays.raised + steepest * rays.aside);
        float tilted = abs(side.y - dot(wave.yz, side.xz)) + abs(top.y - dot(wave.yz, top.xz));
        float curved = gap - tau * (tilted + 0.5 * curvature * tau * rays.aside * rays.aside);
        float longest = max(sloped / fastest, 0.0);
        if (curved > 0.0) {
            float change = rate - tilted - curvature * rays.speed * tau * rays.aside;
            longest = max(longest, safe_step(curved, u_surface_grain, change, 1e30, curvature * rays.speed * rays.speed));
        }
        tau += longest;
        if (longest < START_SHARE * tau * rays.raised) {
            break;
        }
    }
    // What lies behind that place bends no ray of the tile any more.
    return vec3(min(tau, rays.reach), 0.0, surface_bounds(ray, rays.aside, tau).z);
}

// @part start_anew
// Nothing is known of the tile yet.
vec2 known_free() {
    return vec2(0.0);
}

// @part start_within
// What a pass over wider tiles has found, of those that this tile touches.
uniform sampler2D u_start_wide;

vec2 known_free() {
    ivec2 last = textureSize(u_start_wide, 0) - 1;
    vec2 wide = vec2(last + 1) / u_viewport;
    ivec2 low = clamp(as_int(floor((gl_FragCoord.xy - 0.501) * wide)), ivec2(0), last);
    ivec2 high = clamp(as_int(floor((gl_FragCoord.xy + 0.501) * wide)), ivec2(0), last);
    vec4 a = texel_at(u_start_wide, low);
    vec4 b = texel_at(u_start_wide, ivec2(high.x, low.y));
    vec4 c = texel_at(u_start_wide, ivec2(low.x, high.y));
    vec4 d = texel_at(u_start_wide, high);
    return vec2(min(min(a.r + a.g, b.r + b.g), min(c.r + c.g, d.r + d.g)), min(min(a.b, b.b), min(c.b, d.b)));
}

// @part pass
// How far all rays of a tile of the picture are free. docs/formulae.md, section 3.
out vec4 o_start;

void main() {
    pyramid_free = known_free();
    // From the middle ray to the tile's sides; a thousandth more, so that no rounding leaves a ray out.
    vec3 found = starts(camera_ray(gl_FragCoord.xy), 1.001 * u_ray_x / u_viewport.x, 1.001 * u_ray_y / u_viewport.y);
    // Half floats hold it all: the way to water in two, what they round on the safe side. No curvature that they cannot hold is told.
    float tau = min(found.r, 65000.0);
    float whole = unpackHalf2x16(packHalf2x16(vec2(tau, 0.0))).x;
    float rest = (tau - whole) - 1e-6 * tau;
    o_start = vec4(whole, rest, min(0.9994 * found.g, 65000.0), found.b > 60000.0 ? 65000.0 : 1.0006 * found.b + 1e-6);
}
