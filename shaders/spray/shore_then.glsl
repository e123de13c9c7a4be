// The shore's waves of an earlier time: theirs of now, with their phase turned back and the height that the mask gave them then.
uniform float u_spray_period;     // of the surf, s
uniform float u_spray_variation;  // of its height
uniform vec2 u_spray_mask[4];     // wavevectors of the mask, rad/m
uniform float u_spray_mask_phase[4];
uniform float u_spray_mask_rate[4]; // rad/s

// What the mask leaves of the height at a place of the square, age seconds ago.
float shore_rhythm(vec2 q, float age) {
    float sum = 0.0;
    for (int i = 0; i < 4; ++i) {
        sum += sin(wrap_phase(u_spray_mask_phase[i] + dot(u_spray_mask[i], q) - u_spray_mask_rate[i] * age));
    }
    return 1.0 - u_spray_variation * smoothstep(-0.8, 0.8, 0.5 * sum);
}

// Height of the shore's waves where its map says f, age seconds ago, m.
float shore_then(ShoreField f, vec2 q, float age) {
    float turn = fract(shore_turn(f.here.r) + age / u_spray_period);
    float height = f.here.g * shore_rhythm(q, age) / max(shore_rhythm(q, 0.0), 1e-3);
    return max(height, 0.0) * shore_profile(turn, f.here.b).x;
}
