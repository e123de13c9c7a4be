// A drop: its chances, and ballistics with linear drag in closed form. docs/formulae.md, section 13.
uniform vec2 u_spray_wind; // m/s

// What is thrown up: sheets that tear into ligaments and drops, puffs of mist, spindrift, and the water of a blast's column.
const float SPRAY_SHEET = 0.0;
const float SPRAY_MIST = 1.0;
const float SPRAY_DRIFT = 2.0;
const float SPRAY_COLUMN = 3.0;

// birth: from the eye along x and z, its height, m; velocity: m/s; age and life: s; radius: m at birth; strength: its share of the
// full opacity.
struct Drop {
    vec3 birth;
    vec3 velocity;
    float age;
    float life;
    float radius;
    float strength;
    float kind;
    uint word;
};

// The k-th number in [0, 1) that goes with a word.
float spray_part(uint word, uint k) {
    return noise_share(noise_hash(word + k));
}

// Velocity at which a drop no longer speeds up or slows down, m/s. tau: time in which the air takes a drop to 1/e of its speed against
// that, s; weight: its fall without air, m/s2.
vec3 spray_last(float tau, float weight) {
    return vec3(u_spray_wind.x, -weight * tau, u_spray_wind.y);
}

// Where a drop is, age seconds after its birth.
vec3 spray_flight(vec3 birth, vec3 velocity, float age, float tau, float weight) {
    vec3 last = spray_last(tau, weight);
    return birth + last * age + (velocity - last) * (tau * (1.0 - exp(-age / tau)));
}

// And how fast.
vec3 spray_speed(vec3 velocity, float age, float tau, float weight) {
    vec3 last = spray_last(tau, weight);
    return last + (velocity - last) * exp(-age / tau);
}
