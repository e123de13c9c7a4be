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
