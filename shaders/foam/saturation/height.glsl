// Foam from the water's height (Yingst, Alford and Parberry 2011).

// @part plain
// Foam by height, f = (H - H0)/(Hmax - H0) (Kryachko 2005); heights in metres, f in [0, 4].
uniform float u_height_level; // still water over the paper's troughs, from which H0 and Hmax count, m
uniform float u_height_base;  // H0, m
uniform float u_height_full;  // Hmax, at least 1 mm above H0, m

float height_saturation(vec2 p, float height, Footprint fp) {
    return clamp((height + u_height_level - u_height_base) / max(u_height_full - u_height_base, 1e-3), 0.0, 4.0);
}

// @part seen
// Foam by height, f = (H - H0)/(Hmax - H0) (Kryachko 2005), held in [0, 1] and averaged over the heights under the footprint, as far
// as the eye sees them: toward the horizon crests alone. docs/formulae.md, section 4.
uniform float u_height_level; // still water over the paper's troughs, from which H0 and Hmax count, m
uniform float u_height_base;  // H0, m
uniform float u_height_full;  // Hmax, at least 1 mm above H0, m
uniform vec4 u_height_wave;   // the highest wave: k (rad/m); mean height of all waves over the troughs (m); 1 / their greatest slope
uniform vec2 u_height_seen[HEIGHT_NODES]; // mean and deviation (m) of the heights that rays see, evenly by the root of their fall

// Mean of max(t - n, 0) over n that lie under a parabola from -reach to reach.
float height_above(float t, float reach) {
    float y = clamp(0.5 + 0.5 * t / reach, 0.0, 1.0);
    return 2.0 * reach * y * y * y * (1.0 - 0.5 * y) + max(t - reach, 0.0);
}

float height_saturation(vec2 p, float height, Footprint fp) {
    float way = max(length(p), 1e-6);
    float along = max(abs(dot(u_height_wave.xy, p)) / (way * length(u_height_wave.xy)), 1e-3);
    // From below all count alike: which troughs hang before which is not told.
    float over = u_eye_height - height;
    float falls = over > 0.0 ? min(over / (way * along) * u_height_wave.w, 1.0) : 1.0;
    float x = sqrt(falls) * float(HEIGHT_NODES - 1);
    int i = min(as_int(floor(x)), HEIGHT_NODES - 2);
    vec2 seen = mix(u_height_seen[i], u_height_seen[i + 1], x - float(i));
    float kept = 1.0;
    float raised = height + u_height_level;
    float middle = raised;
    if (SURFACE_FILTER) {
        float shown = wave_kept(u_height_wave.xy, fp);
        kept = min(wave_kept(u_height_wave.xy, level_footprint(p, height)), shown);
        middle = u_height_wave.z + kept / max(shown, 1e-6) * (raised - u_height_wave.z) + (1.0 - kept) * (seen.x - u_height_wave.z);
    }
    float range = max(u_height_full - u_height_base, 1e-3);
    // The parabola's variance is a fifth of its reach squared.
    float reach = max(sqrt(5.0 * (1.0 - kept * kept)) * seen.y, 1e-3 * range);
    return clamp((height_above(middle - u_height_base, reach) - height_above(middle - u_height_full, reach)) / range, 0.0, 1.0);
}

// @part filtered
// Foam by height, f = (H - H0)/(Hmax - H0) (Kryachko 2005); heights in metres, f in [0, 1], as the filtered look takes it.
uniform float u_height_level; // still water over the paper's troughs, from which H0 and Hmax count, m
uniform float u_height_base;  // H0, m
uniform float u_height_full;  // Hmax, at least 1 mm above H0, m

float height_saturation(vec2 p, float height, Footprint fp) {
    return clamp((height + u_height_level - u_height_base) / max(u_height_full - u_height_base, 1e-3), 0.0, 1.0);
}

// @part level
// The footprint on level water, from place and height. The one on a wave's face that is turned to the eye is shorter, but the pixel
// sees on over its crest to the next waves. docs/formulae.md, section 4.
Footprint level_footprint(vec2 p, float height) {
    vec3 way = vec3(p.x, height - u_eye_height, p.y);
    float tau = max(dot(way, u_ray_z) / dot(u_ray_z, u_ray_z), 1e-6);
    return footprint(way / tau, tau, vec3(0.0, way.y > 0.0 ? -1.0 : 1.0, 0.0));
}
