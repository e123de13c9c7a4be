#version 300 es
// The scene without waves, ripples, foam or floor, by hand: level water under sun and sky.
precision highp float;

uniform vec2 u_viewport;
uniform float u_eye_height;
uniform vec3 u_ray_x;
uniform vec3 u_ray_y;
uniform vec3 u_ray_z;
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

void main() {
    vec2 clip = 2.0 * gl_FragCoord.xy / u_viewport - 1.0;
    vec3 ray = u_ray_z + clip.x * u_ray_x + clip.y * u_ray_y;
    if (ray.y >= 0.0) {
        discard;
    }
    float reach = length(ray);
    vec3 d = ray / reach;

    float sigma2 = u_roughness * u_roughness;
    float nv2 = d.y * d.y;
    float cv = sqrt(nv2 + sigma2 * (1.0 - nv2));
    float reflectance = fresnel(min(cv, 1.0));
    vec3 reflected = sky(normalize(vec3(d.x, sqrt(nv2 + sigma2), d.z)));
    vec3 below = 0.95 / PI * (u_sun_irradiance * u_sun_direction.y + u_sky_irradiance);
    vec3 body = 0.4 * u_scattering / (1.0 / u_absorption_length + u_scattering) * below;

    vec3 h = normalize(u_sun_direction - d);
    float nh2 = max(h.y * h.y, 1e-6);
    float slopes = exp(-max(1.0 - nh2, 0.0) / (nh2 * sigma2)) / (PI * sigma2 * nh2 * nh2);
    vec3 glitter = u_sun_irradiance * (fresnel(max(dot(u_sun_direction, h), 0.0)) * slopes / (4.0 * cv));

    vec3 water = (1.0 - reflectance) * body + reflectance * reflected + min(glitter, 1e4);
    vec3 haze = u_air_horizon * scattered(dot(normalize(d.xz), u_sun_direction.xz));
    float clear = exp(-3.912 / u_visibility * (u_eye_height / -ray.y * reach));
    o_color = vec4(min(exp2(u_exposure) * mix(haze, water, clear), 65504.0), 0.0);
}
