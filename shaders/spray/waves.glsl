// Drops thrown up by waves: each looks at four places round the eye and starts from the one where the water rises fastest, if
// that is fast enough. Waves of an earlier time are theirs of now, their phases turned back by the drop's age.
uniform float u_spray_time[2];  // t modulo a life, and modulo 65536 lives, s
uniform float u_spray_life;     // s
uniform float u_spray_speed;
uniform float u_spray_threshold; // m/s
uniform float u_spray_reach;    // m
uniform vec2 u_spray_eye;       // the eye's place in squares of twice the reach, m
uniform float u_parametric_rate[PARAMETRIC_COUNT]; // rad/s

// Height, gradient and rise (m/s) of the waves at a place, age seconds ago.
vec4 spray_waves(vec2 p, float age) {
    vec4 sum = vec4(-u_parametric_level, 0.0, 0.0, 0.0);
    for (int i = 0; i < PARAMETRIC_COUNT; ++i) {
        vec4 wave = u_parametric[i];
        vec2 of_half = parametric_half(u_parametric_phase[i] - dot(wave.xy, p) - u_parametric_rate[i] * age);
        vec2 profile = wave.z * parametric_profile(of_half, wave.w, parametric_kind(i));
        sum += vec4(profile.x, -profile.y * wave.xy, profile.y * u_parametric_rate[i]);
    }
    return sum;
}

// birth: from the eye along x and z, its height; false: the drop was never born.
bool spray_born(int i, out vec3 birth, out vec3 velocity, out float age, out uint word) {
    uint own = noise_hash(uint(i));
    float turn = u_spray_time[0] / u_spray_life + spray_part(own, 0u);
    int epoch = int(floor((u_spray_time[1] - u_spray_time[0]) / u_spray_life + 0.5)) + int(turn);
    age = (turn - floor(turn)) * u_spray_life;
    word = noise_hash(own ^ uint(epoch & 65535));
    float side = 2.0 * u_spray_reach;
    vec2 at = vec2(0.0);
    vec4 fastest = vec4(-1.0);
    for (uint k = 8u; k < 16u; k += 2u) {
        vec2 p = side * vec2(spray_part(word, k), spray_part(word, k + 1u)) - u_spray_eye;
        p -= side * floor(p / side + 0.5);
        vec4 wave = spray_waves(p, age);
        if (wave.w > fastest.w) {
            fastest = wave;
            at = p;
        }
    }
    birth = vec3(at.x, fastest.x, at.y);
    // Level lines of the wave go on at rise over slope; a crest has none, and is held.
    vec2 onward = -fastest.yz * (fastest.w / max(dot(fastest.yz, fastest.yz), 0.02));
    vec2 aside = fastest.w * (vec2(spray_part(word, 2u), spray_part(word, 3u)) - 0.5);
    velocity = vec3(0.0, u_spray_speed * fastest.w * (0.4 + 0.6 * spray_part(word, 1u)), 0.0);
    velocity.xz = onward * (0.4 + 0.6 * spray_part(word, 4u)) + aside;
    return fastest.w > u_spray_threshold && length(at) < u_spray_reach;
}
