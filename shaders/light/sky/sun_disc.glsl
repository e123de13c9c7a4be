// The sun's disc, 0.53 degrees wide; by the chord, which keeps its precision where the cosine does not.
uniform vec3 u_sun_disc; // radiance

vec3 sun_disc(vec3 d) {
    vec3 chord = d - u_sun_direction;
    return u_sun_disc * (1.0 - smoothstep(2.025e-5, 3.025e-5, dot(chord, chord)));
}
