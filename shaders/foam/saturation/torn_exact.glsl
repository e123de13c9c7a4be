// Torn foam at a point, as in torn.glsl without a footprint.
const vec2 TORN_NONE = vec2(0.0);

vec2 torn_noise(vec2 sum, float share, float cell, float noise, Footprint fp) {
    return sum + vec2(share * noise, 0.0);
}

float torn_step(float low, float high, float x, float variance) {
    return smoothstep(low, high, x);
}

float torn_variance(vec2 change, float unit, Footprint fp) {
    return 0.0;
}
