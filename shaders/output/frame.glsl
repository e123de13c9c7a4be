// From samples to the frame, and its display; the frame's geometry as numbers.

// @part finished
// The finished frame in linear light, at a pixel. A: the water's foam amount.
uniform sampler2D u_linear;

vec4 finished() {
    return texel_at(u_linear, as_int(floor(gl_FragCoord.xy)));
}

// @part beneath
// Surface and sky that are drawn at full width.
uniform sampler2D u_beneath;

vec4 beneath() {
    return texel_at(u_beneath, as_int(floor(gl_FragCoord.xy)));
}

// @part above
// What stands before surface and sky (premultiplied alpha), at a place in pixels.
uniform sampler2D u_above;

vec4 above(vec2 pixel) {
    return texel_at(u_above, as_int(floor(pixel)));
}

// @part viewport
// Width and height of the picture, pixels.
uniform vec2 u_viewport;

// @part above_coarse
// The same where it has fewer pixels.
uniform sampler2D u_above;

vec4 above(vec2 pixel) {
    return textureLod(u_above, pixel / u_viewport, 0.0);
}

// @part laid
// One laid over the other; A stays that of the lower.
vec4 laid(vec4 under, vec4 over) {
    return vec4(min(under.rgb * (1.0 - min(over.a, 1.0)) + over.rgb, BRIGHTEST), under.a);
}

// @part composed
// The finished frame, of what stands before surface and sky and of these.
vec4 finished() {
    return laid(beneath(), above(gl_FragCoord.xy));
}

// @part write
// The finished frame as a picture.
out vec4 o_color;

void main() {
    o_color = finished();
}

// @part resolve
// Mean of SAMPLE_SIDE x SAMPLE_SIDE samples, in linear light.
uniform sampler2D u_samples;
out vec4 o_color;

void main() {
    ivec2 corner = as_int(floor(gl_FragCoord.xy)) * SAMPLE_SIDE;
    vec4 sum = vec4(0.0);
    for (int j = 0; j < SAMPLE_SIDE; ++j) {
        for (int i = 0; i < SAMPLE_SIDE; ++i) {
            sum += texel_at(u_samples, corner + ivec2(i, j));
        }
    }
    o_color = sum / float(SAMPLE_SIDE * SAMPLE_SIDE);
}

// @part present
// Linear light to the screen: tone curve, then the sRGB transfer curve (IEC 61966-2-1), by hand since formats disagree on it.
out vec4 o_color;

// x in [0, 1]. 1.055 x^(5/12) - 0.055 as a polynomial in x^(1/4), to 0.002 of a level: a power costs as much as two roots and more.
vec3 srgb(vec3 x) {
    vec3 s = sqrt(sqrt(max(x, 0.0031308)));
    vec3 curved = -0.0614833354 + s * (0.163495493 + s * (1.24977997 + s * (-0.567387739 + s * (0.280971055 - 0.0653806371 * s))));
    return mix(12.92 * x, curved, step(0.0031308, x));
}

void main() {
    o_color = vec4(srgb(tone(max(with_glare(finished().rgb), 0.0))), 1.0);
}

// @part geometry
// Normal (unit, over water that of its ripples too) and distance (m) of what the ray of a sample meets; 0 where it meets nothing.
out vec4 o_geometry;

void main() {
    vec3 ray = camera_ray(sample_place());
    float tau;
    vec3 wave;
    vec4 ground;
    int met = first_met(ray, tau, wave, ground);
    vec2 slope = ground.yz;
    if (met == WATER) {
        vec2 p = tau * ray.xz;
        Footprint fp = footprint(ray, tau, vec3(-wave.y, 1.0, -wave.z));
        slope = waves_shading(p, fp).yz + detail(p, fp).xy;
    }
    o_geometry = met == 0 ? vec4(0.0) : vec4(normalize(vec3(-slope.x, 1.0, -slope.y)), tau * length(ray));
}

// @part geometry_below
// The same from under the water: of its underside, whose normal is up too, or of the floor.
out vec4 o_geometry;

const float NO_FLOOR = 1e5;

void main() {
    vec3 ray = camera_ray(sample_place());
    vec3 d = normalize(ray);
    float tau;
    vec3 wave;
    bool underside = find_underside(ray, tau, wave);
    float reach = bed_reach(vec2(0.0), u_eye_height, d);
    o_geometry = reach < NO_FLOOR ? vec4(floor_normal(reach * d.xz), reach) : vec4(0.0);
    if (underside && tau * length(ray) <= reach) {
        vec2 p = tau * ray.xz;
        Footprint fp = footprint(ray, tau, vec3(wave.y, -1.0, wave.z));
        vec2 slope = waves_shading(p, fp).yz + detail(p, fp).xy;
        o_geometry = vec4(normalize(vec3(-slope.x, 1.0, -slope.y)), tau * length(ray));
    }
}
