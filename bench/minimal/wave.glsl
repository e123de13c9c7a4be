#version 300 es
// Preset paper-wake without ripples, under equation 1, by hand: one wave with K = 2, so u^K is a product; the front's phase is
// the wave's own, so one sine and one cosine serve surface, normal and foam. For an eye above the crests.
precision highp float;
precision highp int;
precision highp usampler2D;

uniform vec2 u_viewport;
uniform float u_eye_height;
uniform vec3 u_ray_x;
uniform vec3 u_ray_y;
uniform vec3 u_ray_z;
uniform float u_surface_steepest;
uniform sampler2D u_start;
uniform vec4 u_parametric[1];
uniform float u_parametric_phase[1];
uniform vec3 u_parametric_mean[1];
uniform float u_front_intensity;
uniform vec4 u_mask_matrix;
uniform vec2 u_mask_offset;
uniform usampler2D u_mask_ranks;
uniform float u_foam_albedo;
uniform float u_translucency;
uniform vec3 u_sun_direction;
uniform vec3 u_sun_irradiance;
uniform vec3 u_sky_irradiance;
uniform vec3 u_air_rayleigh;
uniform vec3 u_air_mie;
uniform vec3 u_air_even;
uniform vec3 u_air_depth;
uniform vec3 u_air_horizon;
uniform vec3 u_absorption_length;
uniform float u_scattering;
uniform float u_roughness;
uniform float u_visibility;
uniform float u_exposure;
out vec4 o_color;

const float PI = 3.14159265358979;

float fresnel(float c) {
    float q = sqrt(0.7956 + c * c);
    float s = c * (q - c) + 1.0;
    float p = c * (q + c) - 1.0;
    float a = (q - c) / ((q + c) * s);
    return 0.5 * a * a * (s * s + p * p);
}

vec3 scattered(float gamma) {
    return u_air_even + (1.0 + gamma * gamma) * u_air_rayleigh + u_air_mie / pow(1.5776 - 1.52 * gamma, 1.5);
}

vec3 sky(vec3 d) {
    return scattered(dot(d, u_sun_direction)) * (1.0 - exp(-u_air_depth / (d.y + 0.09)));
}

float theta(float x) {
    float n = floor(x * 0.159154943091895 + 0.5);
    return (x - n * 6.28125) - n * 1.93530717958648e-3;
}

vec3 irradiance(vec3 n) {
    return u_sun_irradiance * max(dot(n, u_sun_direction), 0.0) + u_sky_irradiance * (0.5 + 0.5 * n.y);
}

void main() {
    vec2 clip = 2.0 * gl_FragCoord.xy / u_viewport - 1.0;
    vec3 ray = u_ray_z + clip.x * u_ray_x + clip.y * u_ray_y;
    if (ray.y >= 0.0) {
        discard;
    }
    vec2 k = u_parametric[0].xy;
    float amplitude = u_parametric[0].z;
    float phase = u_parametric_phase[0];
    float speed = length(ray.xz);
    float size = length(ray);
    vec3 d = ray / size;

    // The surface: from where the tile's rays are free by steps that cannot pass it. Heights count from the trough.
    float eye = u_eye_height + u_parametric_mean[0].y;
    vec4 start = texelFetch(u_start, ivec2(gl_FragCoord.xy * vec2(textureSize(u_start, 0)) / u_viewport), 0);
    float along = dot(k, ray.xz);
    float farthest = 1e5 / speed;
    float leave = min(eye / -ray.y, farthest);
    float fine = 0.05 * length(u_ray_y) * 2.0 / u_viewport.y;
    float step_size = 1.0 / (u_surface_steepest * speed - ray.y);
    float curvature = start.a * speed * speed;
    float enter = min(max((eye - amplitude) / -ray.y, start.r + start.g), leave);
    float tau = enter;
    float gap = 0.0;
    float rate = 0.0;
    vec2 turn = vec2(0.0);
    for (int i = 0; i < 192; ++i) {
        float angle = theta(phase - tau * along);
        turn = vec2(cos(angle), sin(angle));
        float u = 0.5 + 0.5 * turn.y;
        gap = eye + tau * ray.y - amplitude * u * u;
        rate = ray.y + amplitude * u * turn.x * along;
        if (tau >= leave || (gap < fine * tau && (gap < 0.0 || rate < 0.0))) {
            break;
        }
        float free = max(gap, 0.0) + fine * tau;
        float root = sqrt(rate * rate + 2.0 * curvature * free);
        tau += max(free * step_size, rate < 0.0 ? 2.0 * free / (root - rate) : (root + rate) / curvature);
    }
    vec2 p = tau * ray.xz;
    float u = 0.5 + 0.5 * turn.y;
    vec2 slope = -amplitude * u * turn.x * k;

    // What the footprint leaves of the wave.
    vec3 normal = vec3(-slope.x, 1.0, -slope.y);
    float facing = min(dot(normal, ray), -1e-3 * length(normal) * size);
    float a = tau * (2.0 / u_viewport.x) * dot(k, u_ray_x.xz - ray.xz * (dot(normal, u_ray_x) / facing));
    float b = tau * (2.0 / u_viewport.y) * dot(k, u_ray_y.xz - ray.xz * (dot(normal, u_ray_y) / facing));
    float kept = exp(-min(a * a + b * b, 1800.0) / 24.0);
    float height = mix(u_parametric_mean[0].y, amplitude * u * u, kept);
    float base2 = u_roughness * u_roughness;
    float lost2 = (1.0 - kept * kept) * u_parametric_mean[0].x;
    float sigma2 = base2 + lost2;
    vec3 n = normalize(vec3(-kept * slope.x, 1.0, -kept * slope.y));

    // Foam.
    float cotangent = turn.x > 0.0 ? (1.0 + turn.x) / turn.y : turn.y / (1.0 - turn.x);
    float f = exp(clamp(cotangent, -80.0, 80.0)) / u_front_intensity;
    vec2 uv = vec2(dot(u_mask_matrix.xy, p), dot(u_mask_matrix.zw, p)) + u_mask_offset;
    uint rank = texelFetch(u_mask_ranks, ivec2(floor(uv * 512.0)) & 511, 0).r;
    bool foamy = f > (float(rank) + 0.5) / 65536.0;

    // Light.
    float nv = max(-dot(n, d), 0.0);
    float aside2 = max(1.0 - nv * nv, 1e-8);
    float cv = sqrt(nv * nv + sigma2 * aside2);
    float lean = sqrt(0.5 * lost2 * aside2);
    vec2 c = clamp(nv + vec2(lean, -lean), 0.0, 1.0);
    vec2 raised = sqrt(c * c + base2 * (1.0 - c * c));
    vec2 mirrors = (c + 5e-7) / (c.x + c.y + 1e-6) * vec2(fresnel(raised.x), fresnel(raised.y));
    float reflectance = mirrors.x + mirrors.y;
    vec3 facet = n - lean * (mirrors.x - mirrors.y) / (reflectance * aside2) * (d + nv * n);
    vec3 r = d - 2.0 * dot(d, facet) / dot(facet, facet) * facet;
    r.y = sqrt(max(r.y, 0.0) * max(r.y, 0.0) + base2 + 0.5 * lost2);
    vec3 reflected = sky(normalize(r));
    vec3 light = irradiance(n);
    vec3 absorption = 1.0 / u_absorption_length;
    vec3 body = 0.38 / PI * u_scattering / (absorption + u_scattering) * light;
    float crest = height / amplitude;
    float toward_sun = max(dot(d.xz, u_sun_direction.xz), 0.0);
    body += u_translucency / PI * u_sun_irradiance * exp(-6.0 * absorption) * (crest * crest * toward_sun);
    vec3 h = normalize(u_sun_direction - d);
    float nh = max(dot(n, h), 1e-3);
    float nh2 = nh * nh;
    float slopes = exp(-max(1.0 - nh2, 0.0) / (nh2 * sigma2)) / (PI * sigma2 * nh2 * nh2);
    vec3 glitter = u_sun_irradiance * (fresnel(max(dot(u_sun_direction, h), 0.0)) * slopes / (4.0 * cv));
    vec3 water = (1.0 - reflectance) * body + reflectance * reflected + min(glitter, 1e4);

    vec3 seen = foamy ? u_foam_albedo / PI * light : water;
    vec3 haze = u_air_horizon * scattered(dot(ray.xz, u_sun_direction.xz) / speed);
    float clear = exp(-3.912 / u_visibility * tau * size);
    o_color = vec4(min(exp2(u_exposure) * mix(haze, seen, clear), 65504.0), foamy ? 1.0 : 0.0);
}
