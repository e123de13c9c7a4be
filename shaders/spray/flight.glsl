// A drop in the air: its chances, and ballistics with linear drag in closed form. docs/formulae.md, section 13.
uniform vec2 u_spray_wind; // m/s

// The k-th number in [0, 1) that goes with a word.
float spray_part(uint word, uint k) {
    return noise_share(noise_hash(word + k));
}

// Where a drop is, age seconds after its birth; tau: time in which the air takes it to 1/e of its speed against the wind's, s;
// weight: its fall without air, m/s2.
vec3 spray_flight(vec3 birth, vec3 velocity, float age, float tau, float weight) {
    vec3 last = vec3(u_spray_wind.x, -weight * tau, u_spray_wind.y);
    return birth + last * age + (velocity - last) * (tau * (1.0 - exp(-age / tau)));
}
