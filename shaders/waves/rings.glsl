// Rings of waves: exact, from a map, and from a touch.

// @part ring
// One ring around its centre (Kryachko 2005): eta = (I0 e^(-b s) - d) cos(k rho - omega s) between its front and its tail.
// Metres, seconds. rho = sqrt(r^2 + a^2) - a is r with its tip rounded, so nothing is divided by 0 at the centre; s, the age,
// and the way from the centre are reduced in float64. Exact to float32 while omega s < 1e4. docs/formulae.md, section 2.

// way: from the centre, m. now: unused, unused, s, what lies behind the front (m). shape: I0 (m), k (rad/m), omega (rad/s), b (1/s).
// Returns eta, d eta / d rho, 1 / sqrt(r^2 + a^2), and the amplitude here and now.
vec4 ring_profile(vec2 way, vec4 now, vec4 shape) {
    float amplitude = shape.x * exp(-shape.w * now.z) - max(RING_DEAD, RING_DEAD_SHARE * shape.x);
    float wavelength = TAU / shape.y;
    float soft = RING_SOFT * wavelength;
    float square = dot(way, way);
    float far = sqrt(square + soft * soft);
    float rho = square / (far + soft);
    float front = shape.z / shape.y * now.z;
    if (amplitude <= 0.0 || rho >= front) {
        return vec4(0.0, 0.0, 1.0 / far, 0.0);
    }
    float band = 1.0 / (RING_FRONT * wavelength);
    float q = min((front - rho) * band, 1.0);
    float end = front - now.w - 2.0 * RING_FRONT * wavelength;
    float t = clamp((rho - end) * band, 0.0, 1.0);
    float head = q * q * (3.0 - 2.0 * q);
    float tail = t * t * (3.0 - 2.0 * t);
    float change = 6.0 * band * (t * (1.0 - t) * head - q * (1.0 - q) * tail);
    vec2 turn = whole_sine_cosine(wrap_phase(shape.y * rho - shape.z * now.z));
    return vec4(
        amplitude * turn.y * head * tail,
        amplitude * (change * turn.y - shape.y * turn.x * head * tail),
        1.0 / far,
        amplitude * head * tail);
}

// Whether a ring moves the water there: between tail and front, where all else is still.
bool ring_here(vec2 way, vec4 now, vec4 shape) {
    float wavelength = TAU / shape.y;
    float front = shape.z / shape.y * now.z;
    float end = max(front - now.w - 2.0 * RING_FRONT * wavelength, 0.0);
    // rho = x where r^2 = x (x + 2 a).
    float square = dot(way, way);
    return square < front * (front + 2.0 * RING_SOFT * wavelength) && square >= end * (end + 2.0 * RING_SOFT * wavelength);
}

// Position of the lowest bit, 0 where there is none: the exponent of the power of two that it is.
int ring_first(uint bits) {
    return max((floatBitsToInt(float(bits & (~bits + 1u))) >> 23) - 127, 0);
}

// @part reaching
// Which rings reach a texel of a map of rings. Few do, and drivers without branches take both sides of one: so first which, a block at a
// time, then these one by one.
uniform vec4 u_ring_now[RING_COUNT];   // from the centre to the map's corner x, z (m), age (s), what lies behind the front (m)
uniform vec4 u_ring_shape[RING_COUNT]; // I0 (m), k (rad/m), omega (rad/s), b (1/s)
uniform float u_ring_texel;            // m

// A bit for each ring of the block that begins with `from`; p: from the map's corner, m.
uint rings_reaching(vec2 p, int from) {
    uint here = 0u;
    for (int bit = 0; bit < RING_BLOCK; ++bit) {
        int i = min(from + bit, RING_COUNT - 1);
        bool moves = from + bit == i && ring_here(p + u_ring_now[i].xy, u_ring_now[i], u_ring_shape[i]);
        here |= moves ? 1u << uint(bit) : 0u;
    }
    return here;
}

// @part bounds
// Bounds of the rings as their map holds them now.
uniform sampler2D u_ring_bounds;

vec3 rings_bounds(vec3 ray, float aside, float from) {
    return texel_at(u_ring_bounds, ivec2(0)).xyz;
}

// @part exact
// Rings summed at the place itself: exact to float32.
uniform vec4 u_ring_now[RING_COUNT];   // from the centre to the eye x, z (m), age (s), what lies behind the front (m)
uniform vec4 u_ring_shape[RING_COUNT]; // I0 (m), k (rad/m), omega (rad/s), b (1/s)

// Height and its gradient.
vec3 rings_waves(vec2 p) {
    vec3 sum = vec3(0.0);
    for (int i = 0; i < RING_COUNT; ++i) {
        vec2 way = p + u_ring_now[i].xy;
        vec4 ring = ring_profile(way, u_ring_now[i], u_ring_shape[i]);
        sum += vec3(ring.x, ring.y * ring.z * way);
    }
    return sum;
}

// Height and gradient without what is smaller than the footprint, and the unresolved mean square slope.
vec4 rings_shading(vec2 p, Footprint fp) {
    vec4 sum = vec4(0.0);
    for (int i = 0; i < RING_COUNT; ++i) {
        vec2 way = p + u_ring_now[i].xy;
        vec4 ring = ring_profile(way, u_ring_now[i], u_ring_shape[i]);
        float kept = 1.0;
        float k = u_ring_shape[i].y;
        if (SURFACE_FILTER) {
            kept = wave_kept(k * ring.z * way, fp);
        }
        sum += vec4(kept * ring.x, kept * ring.y * ring.z * way, (1.0 - kept * kept) * 0.5 * k * k * ring.w * ring.w);
    }
    return sum;
}

// @part map
// Rings read from the map that the frame drew: exact at its texels, bilinear between them, still water beyond its rim.
uniform sampler2D u_ring_map;
uniform sampler2D u_ring_grain;
uniform vec2 u_ring_corner;  // from the map's corner to the eye, m
uniform float u_ring_side;   // of the map, m

// Beyond the map's rim the nearest texel is read, and that is still.
vec2 rings_uv(vec2 p) {
    return clamp((p + u_ring_corner) / u_ring_side, 0.0, 1.0);
}

// Height and its gradient.
vec3 rings_waves(vec2 p) {
    return textureLod(u_ring_map, rings_uv(p), 0.0).xyz;
}

// Height and gradient without what is smaller than the footprint, and the unresolved mean square slope.
vec4 rings_shading(vec2 p, Footprint fp) {
    vec2 uv = rings_uv(p);
    vec3 here = textureLod(u_ring_map, uv, 0.0).xyz;
    float kept = 1.0;
    float slopes = 0.0;
    if (SURFACE_FILTER) {
        vec4 grain = textureLod(u_ring_grain, uv, 0.0);
        slopes = grain.w;
        vec3 across = vec3(
            fp.x.x * fp.x.x + fp.y.x * fp.y.x,
            2.0 * (fp.x.x * fp.x.y + fp.y.x * fp.y.y),
            fp.x.y * fp.x.y + fp.y.y * fp.y.y);
        // Still water has no grain: 0/0.
        kept = wave_kept(max(dot(grain.xyz, across), 0.0) / max(slopes, 1e-6));
    }
    return vec4(kept * here, (1.0 - kept * kept) * slopes);
}

// @part map_pass
// Dynamic displacement mapping (Kryachko 2005): the rings' heights and slopes, drawn each frame into a map that lies still on
// the water. r: height over still water (m), g, b: gradient.
out vec4 o_ring;

void main() {
    vec2 p = gl_FragCoord.xy * u_ring_texel;
    vec3 sum = vec3(0.0);
    for (int from = 0; from < RING_COUNT; from += RING_BLOCK) {
        for (uint here = rings_reaching(p, from); here != 0u; here &= here - 1u) {
            int i = from + ring_first(here);
            vec2 way = p + u_ring_now[i].xy;
            vec4 ring = ring_profile(way, u_ring_now[i], u_ring_shape[i]);
            sum += vec3(ring.x, ring.y * ring.z * way);
        }
    }
    o_ring = vec4(sum, 0.0);
}

// @part grain_pass
// The grain of the map of rings: what a footprint needs to know to take their waves out. a: mean square slope of the waves here;
// r, g, b: xx, xz, zz of k k^T, weighed by it (1/m^2).
out vec4 o_grain;

void main() {
    vec2 p = gl_FragCoord.xy * u_ring_texel;
    vec4 sum = vec4(0.0);
    for (int from = 0; from < RING_COUNT; from += RING_BLOCK) {
        for (uint here = rings_reaching(p, from); here != 0u; here &= here - 1u) {
            int i = from + ring_first(here);
            vec2 way = p + u_ring_now[i].xy;
            vec4 ring = ring_profile(way, u_ring_now[i], u_ring_shape[i]);
            float steepness = u_ring_shape[i].y * ring.w;
            vec2 k = u_ring_shape[i].y * ring.z * way;
            sum += 0.5 * steepness * steepness * vec4(k.x * k.x, k.x * k.y, k.y * k.y, 1.0);
        }
    }
    o_grain = sum;
}

// @part touch
// Rings of touches, summed at the place itself: slopes without height. Their shape follows from their strength alone, so that the list
// of touches can change while a program stays. docs/formulae.md, section 2.
uniform vec4 u_touch[TOUCH_COUNT]; // from the centre to the eye x, z (m), age (s), strength I0 (m); 0: no touch

// Gradient, and the unresolved mean square slope.
vec3 touches_detail(vec2 p, Footprint fp) {
    vec3 sum = vec3(0.0);
    // None if the first entry is empty. A bound that compilers know would have them write all rings out, which takes minutes.
    int count = u_touch[0].w > 0.0 ? TOUCH_COUNT : 0;
    for (int i = 0; i < count; ++i) {
        vec4 touch = u_touch[i];
        float wavelength = TOUCH_LEAST_LENGTH + TOUCH_LENGTH * touch.w;
        float k = TAU / wavelength;
        vec4 now = vec4(touch.xyz, TOUCH_CRESTS * wavelength);
        vec4 shape = vec4(touch.w, k, sqrt(TOUCH_GRAVITY * k), TOUCH_DECAY);
        vec2 way = p + touch.xy;
        // Of the rings few reach a place, and of a short list most entries are empty.
        if (touch.w <= 0.0 || !ring_here(way, now, shape)) {
            continue;
        }
        vec4 ring = ring_profile(way, now, shape);
        float kept = SURFACE_FILTER ? wave_kept(k * ring.z * way, fp) : 1.0;
        sum += vec3(kept * ring.y * ring.z * way, (1.0 - kept * kept) * 0.5 * k * k * ring.w * ring.w);
    }
    return sum;
}
