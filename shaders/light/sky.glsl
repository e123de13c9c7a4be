// The sky's radiance and the sun's disc.

// @part analytic
// Sky radiance toward d: single scattering in closed form with a flat share for the rest. docs/formulae.md, section 6.
// Any direction; below the horizon the horizon's own colour. Unit: that of the sun's irradiance.
uniform vec3 u_sun_direction;
uniform vec3 u_air_rayleigh; // radiance of the whole air, square to the sun
uniform vec3 u_air_mie;      // and of its haze, over its phase function's power
uniform vec3 u_air_even;     // and of what was scattered more than once
uniform vec3 u_air_depth;    // optical depth at the zenith
uniform vec3 u_air_horizon;  // share of the whole air's light that the horizon has
uniform float u_visibility;  // where 2 % of the contrast is left, m

// Share of light that passes through so much air, m.
float air_passed(float way) {
    return exp(-3.912 / u_visibility * way);
}

// gamma: cosine of the angle from the sun.
vec3 air_scattered(float gamma) {
    // 1 + G^2 - 2 G gamma is at least (1 - G)^2, so the power stays finite
    float apart = max(1.5776 - 1.52 * gamma, 0.0576);
    return u_air_even + (1.0 + gamma * gamma) * u_air_rayleigh + u_air_mie / (apart * sqrt(apart));
}

vec3 sky_light(vec3 d) {
    return air_scattered(dot(d, u_sun_direction)) * (1.0 - exp(-u_air_depth / (max(d.y, 0.0) + 0.09)));
}

// Toward the horizon under or over d; straight up and down are of no heading.
vec3 horizon_light(vec3 d) {
    return air_scattered(dot(d.xz, u_sun_direction.xz) / max(length(d.xz), 1e-6)) * u_air_horizon;
}

// As water mirrors it, by two looks that stand for those of slopes that no sample resolves (spread.z: their deviation up and down, rad).
// r: the mean look, over the horizon.
vec3 mirrored_sky(vec3 r, vec3 spread) {
    float level = length(r.xz);
    vec3 aside = 0.8 * min(spread.z, r.y) * vec3(-r.y * r.xz / max(level, 1e-6), level).xzy;
    return 0.5 * (sky_light(normalize(r + aside)) + sky_light(normalize(r - aside)));
}

// @part glow
// Light of one lamp that clear air scatters: polynomials, fitted for each scene to an integral over a round earth.
// docs/formulae.md, section 9. x: 1 at the horizon, 0.09 at the zenith; s: toward the lamp's azimuth. Coefficients: of x^0 those of
// s^0, s^1 and so on, then of x^1.
uniform vec3 u_glow_lamp;         // toward it
uniform vec2 u_glow_level;        // its azimuth, a unit vector
uniform float u_glow_even[18];    // green of molecules and of all that was scattered more than once, log2
uniform vec2 u_glow_even_tint[11];// what red and blue add
uniform float u_glow_haze[8];     // of haze over its phase function
uniform vec2 u_glow_haze_tint[3];
uniform float u_glow_even_rim[4]; // the same along the horizon, powers of s
uniform vec2 u_glow_even_tint_rim[3];
uniform float u_glow_haze_rim[3];
uniform vec2 u_glow_haze_tint_rim[2];

// green: logarithms of both parts; tints: what red and blue add to them.
vec3 glow_light(vec2 green, vec2 even_tint, vec2 haze_tint, float gamma) {
    vec3 even = exp2(green.x + vec3(even_tint.x, 0.0, even_tint.y));
    return even + exp2(green.y + vec3(haze_tint.x, 0.0, haze_tint.y)) * mie_phase(gamma);
}

vec3 glow(vec3 d) {
    float x = 0.1 / (max(d.y, 0.0) + 0.1);
    float s = dot(d.xz, u_glow_level);
    float even = u_glow_even[15] + s * u_glow_even[16] + x * u_glow_even[17];
    even = x * even + (u_glow_even[12] + s * (u_glow_even[13] + s * u_glow_even[14]));
    even = x * even + (u_glow_even[8] + s * (u_glow_even[9] + s * (u_glow_even[10] + s * u_glow_even[11])));
    even = x * even + (u_glow_even[4] + s * (u_glow_even[5] + s * (u_glow_even[6] + s * u_glow_even[7])));
    even = x * even + (u_glow_even[0] + s * (u_glow_even[1] + s * (u_glow_even[2] + s * u_glow_even[3])));
    vec2 tint = u_glow_even_tint[9] + s * u_glow_even_tint[10];
    tint = x * tint + (u_glow_even_tint[6] + s * (u_glow_even_tint[7] + s * u_glow_even_tint[8]));
    tint = x * tint + (u_glow_even_tint[3] + s * (u_glow_even_tint[4] + s * u_glow_even_tint[5]));
    tint = x * tint + (u_glow_even_tint[0] + s * (u_glow_even_tint[1] + s * u_glow_even_tint[2]));
    float haze = u_glow_haze[6] + s * u_glow_haze[7];
    haze = x * haze + (u_glow_haze[3] + s * (u_glow_haze[4] + s * u_glow_haze[5]));
    haze = x * haze + (u_glow_haze[0] + s * (u_glow_haze[1] + s * u_glow_haze[2]));
    vec2 haze_tint = u_glow_haze_tint[0] + s * u_glow_haze_tint[1] + x * u_glow_haze_tint[2];
    return glow_light(vec2(even, haze), tint, haze_tint, dot(d, u_glow_lamp));
}

// Along the horizon. level: a unit vector, or 0; d: the look, which haze before the horizon scatters toward.
vec3 glow_rim(vec2 level, vec3 d) {
    float s = dot(level, u_glow_level);
    float even = u_glow_even_rim[2] + s * u_glow_even_rim[3];
    even = u_glow_even_rim[0] + s * (u_glow_even_rim[1] + s * even);
    vec2 tint = u_glow_even_tint_rim[0] + s * (u_glow_even_tint_rim[1] + s * u_glow_even_tint_rim[2]);
    float haze = u_glow_haze_rim[0] + s * (u_glow_haze_rim[1] + s * u_glow_haze_rim[2]);
    vec2 haze_tint = u_glow_haze_tint_rim[0] + s * u_glow_haze_tint_rim[1];
    return glow_light(vec2(even, haze), tint, haze_tint, dot(d, u_glow_lamp));
}

// @part layered
// What all lamps of a layered sky share. docs/formulae.md, section 9.
uniform vec3 u_sun_direction;    // toward the lamp: the sun, or the moon once the sun is well down
uniform vec3 u_rayleigh_depth;   // optical depth at the zenith
uniform float u_mie_depth;
uniform float u_haze_depth;      // along the horizon
uniform float u_visibility;      // where 2 % of the contrast is left, m

// Optical depth of the air and the haze along a look.
vec3 air_depth(float y) {
    return (u_rayleigh_depth + u_mie_depth) / (y + 0.09) + u_haze_depth * 0.02 / (y + 0.02);
}

// Share that haze scatters by an angle with the cosine gamma (Henyey and Greenstein 1941, G = 0.76), over the sphere 1.
float mie_phase(float gamma) {
    // 1 + G^2 - 2 G gamma is at least (1 - G)^2, so the power stays finite
    float apart = max(1.5776 - 1.52 * gamma, 0.0576);
    return 0.0336144922 / (apart * sqrt(apart));
}

// Share of light that passes through so much air, m: molecules take more of the blue, and haze the rest that the visibility leaves.
vec3 air_passed(float way) {
    const vec3 MOLECULES = vec3(6.54e-6, 1.405e-5, 3.16e-5);
    vec3 extinction = max(3.912 / u_visibility - MOLECULES.g, 0.0) * vec3(0.826, 1.0, 1.225) + MOLECULES;
    return exp(-extinction * way);
}

// @part exposure
// Exposure as a factor on linear light.
uniform float u_exposure; // stops

float exposure() {
    return exp2(u_exposure);
}

// @part sun_disc
// The sun's disc, 0.53 degrees wide; by the chord, which keeps its precision where the cosine does not.
uniform vec3 u_sun_disc; // radiance

vec3 sun_disc(vec3 d) {
    vec3 chord = d - u_sun_direction;
    float square = dot(chord, chord);
    if (PIXEL_WIDTH == 1.0) {
        return u_sun_disc * (1.0 - smoothstep(2.025e-5, 3.025e-5, square));
    }
    // Of a wide pixel, which is enlarged by what an eye sees of it, the share that the disc covers: to an eye, not of the light.
    float aside = dot(chord, normalize(u_ray_x));
    float reach = sqrt(max(2.9e-5 - square + aside * aside, 0.0));
    float half_pixel = length(u_ray_x) * dot(d, u_ray_z) / u_viewport.x;
    float share = clamp((min(aside + half_pixel, reach) - max(aside - half_pixel, -reach)) / (2.0 * half_pixel), 0.0, 1.0);
    float brightest = exposure() * max(u_sun_disc.r, max(u_sun_disc.g, u_sun_disc.b));
    return u_sun_disc * share / (1.0 + brightest * (1.0 - share));
}

// @part whole
// Air, moonlight and clouds together.
const vec2 SKY_EYE = vec2(7e-4); // detail of clouds that an eye tells apart, rad

vec3 clear_sky(vec3 d) {
    return sun_glow(d) + moon_glow(d);
}

// What clouds leave of the air's light toward d (a), and what they and rain add (rgb); hidden: how much of what is behind all air.
vec4 cloud_veil(vec3 d, vec2 spread, out float hidden) {
    float thin;
    vec4 high = cirrus(d, spread, thin);
    vec4 layer = clouds(d, spread, hidden);
    hidden = 1.0 - (1.0 - thin) * (1.0 - hidden);
    float left = 1.0 - layer.a;
    return in_rain(vec4(high.rgb * left + layer.rgb, (1.0 - high.a) * left), d, spread, hidden);
}

vec3 behind_clouds(vec3 air, vec3 d, vec2 spread, out float hidden) {
    vec4 veil = cloud_veil(d, spread, hidden);
    return air * veil.a + veil.rgb;
}

vec3 sky_seen(vec3 d, vec2 spread) {
    float hidden;
    return behind_clouds(clear_sky(d), d, spread, hidden);
}

vec3 sky_light(vec3 d) {
    return sky_seen(d, SKY_EYE);
}

// Of the haze before the horizon under or over d, where clouds are one; straight up and down are of no heading. There is neither
// cirrus nor rain, and every program that has air would hold all clouds once more.
vec3 horizon_light(vec3 d) {
    vec2 level = d.xz / max(length(d.xz), 1e-6);
    vec4 layer = clouds_along_horizon();
    return (sun_glow_rim(level, d) + moon_glow_rim(level, d)) * (1.0 - layer.a) + layer.rgb;
}

// The air as water mirrors it, whose slopes spread the reflected looks up and down (deviation, rad) about r, over the horizon: two
// looks stand for them, for its light bends most along the horizon.
vec3 mirrored_air(vec3 r, float spread) {
    float level = length(r.xz);
    vec3 aside = 0.8 * min(spread, r.y) * vec3(-r.y * r.xz / max(level, 1e-6), level).xzy;
    return 0.5 * (clear_sky(normalize(r + aside)) + clear_sky(normalize(r - aside)));
}

// @part mirrored
// The sky as water mirrors it, whose slopes spread the reflected looks up and down and aside, and up and down those that no sample
// resolves (deviations, rad). r: their mean, over the horizon.
vec3 mirrored_sky(vec3 r, vec3 spread) {
    float hidden;
    return behind_clouds(mirrored_air(r, spread.x), r, vec2(1.15 * spread.x, spread.y), hidden);
}

// @part mirrored_map
// The same with clouds from a map of the sky over the horizon, in the stereographic projection from straight down, whose levels are as
// many times coarser as slopes spread the looks. docs/formulae.md, section 9.
uniform sampler2D u_clouds_mirrored;

const float CLOUDS_HALF = 0.5 * float(CLOUDS_SIDE); // of the map's side, texels; the horizon is a texel within

vec3 mirrored_sky(vec3 r, vec3 spread) {
    vec2 place = 0.5 + (0.5 - 0.5 / CLOUDS_HALF) * r.xz / (1.0 + r.y);
    // Looks that would spread below the horizon are few, and counted at it.
    float texels = CLOUDS_HALF * (1.0 + r.y) * min(spread.x, r.y);
    vec4 veil = textureLod(u_clouds_mirrored, place, log2(max(texels, 1.0)));
    return mirrored_air(r, spread.x) * veil.a + veil.rgb;
}

// @part mirrored_pass
// That map: of each look over the horizon what clouds leave and add; beyond the horizon what they do there.
out vec4 o_veil;

void main() {
    float half_side = 0.5 * float(CLOUDS_SIDE);
    vec2 q = (gl_FragCoord.xy - half_side) / (half_side - 1.0);
    float far = min(dot(q, q), 1.0);
    vec3 d = normalize(vec3(2.0 * q, max(1.0 - far, 0.0))).xzy;
    float hidden;
    o_veil = cloud_veil(d, vec2(1.0 / half_side), hidden);
}

// @part main
// The sky behind everything. Linear light; no foam.
out vec4 o_color;

void main() {
    vec3 d = normalize(camera_ray(sample_place()));
    o_color = vec4(min(exposure() * (sky_light(d) + sun_disc(d)), BRIGHTEST), 0.0);
}

// @part main_layered
// The sky behind everything, and what stands beyond the air. Linear light; no foam.
out vec4 o_color;

void main() {
    vec3 ray = camera_ray(sample_place());
    vec3 d = normalize(ray);
    float hidden;
    vec3 air = behind_clouds(clear_sky(d), d, SKY_EYE, hidden);
    float pixel = 2.0 * PIXEL_WIDTH * length(u_ray_y) / (u_viewport.y * length(ray));
    vec4 moon = moon_disc(d);
    vec3 beyond = sun_disc(d) + moon.rgb + star_light(d, pixel) * (1.0 - moon.a);
    o_color = vec4(min(exposure() * (air + (1.0 - hidden) * beyond), BRIGHTEST), 0.0);
}
