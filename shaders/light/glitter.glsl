// The sun's glitter on waves that are not resolved.

// @part beckmann
// The sun mirrored by facets whose slopes are Gaussian (Beckmann 1963). d, n: unit vectors; sigma2: mean square slope.
vec3 glitter_light(vec3 d, vec3 n, float sigma2, float cv) {
    vec3 between = u_sun_direction - d;
    vec3 h = between / max(length(between), 1e-6);
    float nh = max(dot(n, h), 1e-3);
    float nh2 = nh * nh;
    float slopes = exp(-max(1.0 - nh2, 0.0) / (nh2 * sigma2)) / (PI * sigma2 * nh2 * nh2);
    return min(u_sun_irradiance * (fresnel(max(dot(u_sun_direction, h), 0.0)) * slopes / (4.0 * cv)), 1e4);
}

// @part blinn_phong
// The lake's highlight (lake water shader, 2008): Blinn-Phong about a half vector that is pushed aside by the normal's own
// tilt, with the source's colour and strength; its white stands for white paper in the sun. d, n: unit vectors.
uniform float u_specular_power;
uniform float u_specular_perturb;

vec3 glitter_light(vec3 d, vec3 n, float sigma2, float cv) {
    vec3 h = u_sun_direction - d + u_specular_perturb * vec3(n.x, 0.0, n.z);
    float nh = clamp(dot(n, h) / max(length(h), 1e-6), 0.0, 1.0);
    return u_sun_irradiance / PI * (0.6 * pow(nh, u_specular_power)) * vec3(0.98, 0.97, 0.7);
}

// @part sparkles
// Sparkles (GPU ocean, 2007): the brighter the sun's smooth reflection, the likelier a cell of the view lights up for an epoch.
// Cells lie on the octahedron of view directions, so a sparkle is as large near as far and in every picture size. Mean over
// hashes: the smooth reflection itself, exactly. Angles in rad, solid angles in sr. docs/formulae.md, section 12.
uniform float u_sparkle_radius;
uniform float u_sparkle_density;  // sparkles alight in a steradian where the glint is the sun's irradiance a steradian
uniform float u_sparkle_share;
uniform float u_sparkle_life;     // s
uniform float u_sparkle_time[2];  // t modulo a life, and modulo 65536 lives, s

// Light of the sparkles toward -d over the sun's irradiance, where the smooth glint is w. radius: of a sparkle, not below
// what the samples can show; side: of a cell on the octahedron.
float sparkle_light(vec3 d, float w, float radius, float side) {
    vec3 q = vec3(d.x, abs(d.y), d.z);
    vec2 at = q.xz / ((abs(q.x) + q.y + abs(q.z)) * side);
    float disc = PI / 3.0 * radius * radius;
    float turn = u_sparkle_time[0] / u_sparkle_life;
    int epoch = as_int(floor((u_sparkle_time[1] - u_sparkle_time[0]) / u_sparkle_life + 0.5));
    float sum = 0.0;
    for (int i = 0; i < SPARKLE_CELLS; ++i) {
        // A sparkle is at most half a cell wide, so four cells may reach here; one alone keeps its sparkle in its middle.
        vec2 cell = SPARKLE_CELLS == 1 ? floor(at) : floor(at - 0.5) + vec2(i & 1, i >> 1);
        uint word = noise_hash(noise_hash(uint(as_int(cell.x))) ^ uint(as_int(cell.y)));
        float age = turn + noise_share(noise_hash(word));
        word = noise_hash(word ^ uint((epoch + as_int(floor(age))) & 65535));
        age -= floor(age);
        vec2 inside = vec2(noise_share(noise_hash(word + 1u)), noise_share(noise_hash(word + 2u)));
        vec2 centre = (cell + (SPARKLE_CELLS == 1 ? 0.5 + 0.19 * (inside - 0.5) : inside)) * side;
        vec3 c = vec3(centre.x, 1.0 - abs(centre.x) - abs(centre.y), centre.y);
        float nearness = inversesqrt(dot(c, c));
        vec3 away = q - c * nearness;
        float edge = max(1.0 - dot(away, away) / (radius * radius), 0.0);
        float solid = side * side * nearness * nearness * nearness;
        float chance = min(u_sparkle_density * w * solid, 1.0);
        // Not lit all at once: a ramp about the chance, as wide on both sides, has the same mean and forgives rounding.
        float soft = max(min(0.25 * chance, 1.0 - chance), 1e-3 * chance);
        float lit = clamp(0.5 + 0.5 * (chance - noise_share(word)) / soft, 0.0, 1.0);
        float swell = 30.0 * age * age * (1.0 - age) * (1.0 - age);
        sum += lit * swell * edge * edge * max(w * solid, 1.0 / u_sparkle_density) / disc;
    }
    return sum;
}

vec3 glitter_light(vec3 d, vec3 n, float sigma2, float cv) {
    vec3 glint = smooth_glitter(d, n, sigma2, cv);
    float w = max((glint.r + glint.g + glint.b) / max(u_sun_irradiance.r + u_sun_irradiance.g + u_sun_irradiance.b, 1e-20), 1e-20);
    float least = 1.5 * max(length(u_ray_x) / u_viewport.x, length(u_ray_y) / u_viewport.y);
    float radius = clamp(least, u_sparkle_radius, 0.25);
    float side = 4.0 * u_sparkle_radius * exp2(ceil(log2(radius / u_sparkle_radius) - 1e-3));
    // Where nearly every cell is alight they run together.
    float l1 = abs(d.x) + abs(d.y) + abs(d.z);
    float apart = u_sparkle_share * (1.0 - smoothstep(0.5, 2.0, u_sparkle_density * w * side * side * l1 * l1 * l1));
    return (1.0 - apart) * glint + apart / w * sparkle_light(d, w, radius, side) * glint;
}
