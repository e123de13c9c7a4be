// Single waves of an earlier time: theirs of now, with their phases turned back.
uniform float u_parametric_rate[PARAMETRIC_COUNT]; // rad/s

// Height, gradient and rise (m/s) of the waves at a place, age seconds ago.
vec4 fronts_then(vec2 p, float age) {
    vec4 sum = vec4(-u_parametric_level, 0.0, 0.0, 0.0);
    for (int i = 0; i < PARAMETRIC_COUNT; ++i) {
        vec4 wave = u_parametric[i];
        vec2 of_half = parametric_half(u_parametric_phase[i] - dot(wave.xy, p) - u_parametric_rate[i] * age);
        vec2 profile = wave.z * parametric_profile(of_half, wave.w, parametric_kind(i));
        sum += vec4(profile.x, -profile.y * wave.xy, profile.y * u_parametric_rate[i]);
    }
    return sum;
}
