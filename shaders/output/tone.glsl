// Curves from linear light to the display.

// @part clamp
// Unlit pictures need no tone curve.
vec3 tone(vec3 x) {
    return clamp(x, 0.0, 1.0);
}

// @part filmic
// Filmic tone curve (Narkowicz 2015, a fit to ACES), from linear light to display light in [0, 1].
vec3 tone(vec3 x) {
    return clamp(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), 0.0, 1.0);
}

// @part photographic
// A tone curve with a long shoulder that holds hue: dim light by its brightest channel alone, as Khronos' PBR Neutral (2024) does,
// bright light more and more channel by channel, so that it pales over gold to white. docs/formulae.md, section 7.
vec3 shoulder(vec3 x) {
    return min(1.01 * x * (x + 0.02) / (x * (x + 0.42) + 0.05), 1.0);
}

vec3 tone(vec3 x) {
    // The brightest channel, without its kinks: sums of cubes over sums of squares, of numbers that no square overflows.
    vec3 y = min(x, 1e4);
    vec3 square = y * y;
    float norm = dot(square, y) / max(dot(square, vec3(1.0)), 1e-12);
    float level = shoulder(vec3(norm)).r;
    vec3 hue = max(1.0 + 1.2 * (y / max(norm, 1e-6) - 1.0), 0.0);
    return clamp(mix(level * hue, shoulder(y), level * level), 0.0, 1.0);
}
