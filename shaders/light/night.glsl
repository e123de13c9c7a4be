// The night's sky: moon, stars, airglow.

// @part night
// The sky once the sun is so deep under the horizon that it lights none of it. docs/formulae.md, section 9.
const vec3 SKY_NIGHT = vec3(0.002, 0.0034, 0.0075);

vec3 sun_glow(vec3 d) {
    return SKY_NIGHT;
}

vec3 sun_glow_rim(vec2 level, vec3 d) {
    return SKY_NIGHT;
}

// @part stars
// Stars: one or none in each cell of a cube of directions, by a hash of its whole numbers; never smaller than a sample.
uniform vec3 u_star_path;        // optical depth of the air at the zenith
uniform float u_star_brightness; // at this time of night

const float STAR_CELLS = 64.0;   // along a side of a face

vec3 star_light(vec3 d, float pixel) {
    int face;
    vec3 turned = cube_face(d, face);
    vec2 at = (turned.xy / turned.z * 0.5 + 0.5) * STAR_CELLS;
    ivec2 cell = as_int(clamp(floor(at), 0.0, STAR_CELLS - 1.0));
    uint word = noise_hash(noise_hash(noise_hash(uint(face) ^ 0x5EA57A25u) ^ uint(cell.x)) ^ uint(cell.y));
    // Corners of the cube have smaller cells: fewer of them hold a star.
    vec2 middle = (vec2(cell) + 0.5) / STAR_CELLS * 2.0 - 1.0;
    float share = 0.5 / pow(1.0 + dot(middle, middle), 1.5);
    if (noise_share(word) >= share) {
        return vec3(0.0);
    }
    uint next = noise_hash(word + 1u);
    uint last = noise_hash(word + 2u);
    vec2 star = (vec2(cell) + 0.25 + 0.5 * vec2(noise_share(next), noise_share(last))) / STAR_CELLS * 2.0 - 1.0;
    vec3 toward = normalize(vec3(star, 1.0));
    vec3 chord = turned - toward;
    // A quarter of the narrowest cell is the most a star may cover.
    float radius = clamp(1.5 * pixel, 7e-4, 3e-3);
    float inside = max(1.0 - dot(chord, chord) / (radius * radius), 0.0);
    // Few are bright: brightness goes with the inverse of the rank.
    float rank = noise_share(noise_hash(word + 3u));
    float flux = 3e-8 / (rank * rank + 0.004);
    float warm = noise_share(noise_hash(word + 4u));
    vec3 tint = mix(vec3(1.0, 0.82, 0.62), vec3(0.72, 0.85, 1.0), warm);
    // The profile (1 - r^2)^2 has the integral pi r^2 / 3.
    float bright = u_star_brightness * flux * 3.0 / (PI * radius * radius) * inside * inside;
    return tint * bright * exp(-u_star_path / (max(d.y, 0.0) + 0.03));
}

// @part moon_disc
// The moon's face: a sphere of rough ground, lit from where the sun is, with seas of noise. docs/formulae.md, section 9.
uniform vec3 u_moon_direction;
uniform vec3 u_moon_right;       // the moon's own axes, unit vectors
uniform vec3 u_moon_up;
uniform float u_moon_radius;     // rad
uniform vec3 u_moon_sun;         // toward the sun along right, up and the eye
uniform vec3 u_moon_radiance;    // of the middle of a full moon

// A: how much of what is behind it hides.
vec4 moon_disc(vec3 d) {
    vec3 chord = d - u_moon_direction;
    float far = dot(chord, chord) / (u_moon_radius * u_moon_radius);
    if (far >= 1.2) {
        return vec4(0.0);
    }
    // Counted, so that drivers without branches sum no seas beside the moon.
    int octaves = far < 1.2 ? 4 : 0;
    vec2 at = vec2(dot(chord, u_moon_right), dot(chord, u_moon_up)) / u_moon_radius;
    vec3 normal = vec3(at, sqrt(max(1.0 - far, 0.0)));
    // Dust throws light back: the disc of a full moon is even, and fades only toward the night.
    float lit = sqrt(max(dot(normal, u_moon_sun), 0.0));
    float seas = smoothstep(-0.2, 0.9, fractal_2(1.7 * at + vec2(3.1, 7.7), 0.0, octaves, 77u));
    float inside = 1.0 - smoothstep(0.8, 1.2, far);
    return vec4(u_moon_radiance * ((1.0 - 0.55 * seas) * lit * inside), inside);
}
