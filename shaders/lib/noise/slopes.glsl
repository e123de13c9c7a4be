// Gradient noise in the plane that never repeats (Perlin 2002: quintic fade), one cell a unit, standard deviation 1, and its gradient.
vec2 noise_way(uint column, int j) {
    uint word = noise_hash(column ^ uint(j));
    return vec2(float(word & 65535u), float(word >> 16u)) / 32767.5 - 1.0;
}

vec3 noise_slopes(uint key, vec2 x) {
    vec2 base = floor(x);
    vec2 t = x - base;
    ivec2 cell = ivec2(base);
    uint near = noise_hash(uint(cell.x) ^ key);
    uint far = noise_hash(uint(cell.x + 1) ^ key);
    vec2 a = noise_way(near, cell.y);
    vec2 b = noise_way(far, cell.y);
    vec2 c = noise_way(near, cell.y + 1);
    vec2 e = noise_way(far, cell.y + 1);
    float at_a = dot(a, t);
    float at_b = dot(b, t - vec2(1.0, 0.0)) - at_a;
    float at_c = dot(c, t - vec2(0.0, 1.0)) - at_a;
    float twist = dot(e, t - vec2(1.0, 1.0)) - at_a - at_b - at_c;
    vec2 w = t * t * t * (t * (t * 6.0 - 15.0) + 10.0);
    vec2 s = 30.0 * t * t * (1.0 - t) * (1.0 - t);
    // 5.672: over the standard deviation of the sum.
    return 5.672 * vec3(
        at_a + w.x * at_b + w.y * at_c + w.x * w.y * twist,
        a + w.x * (b - a) + w.y * (c - a) + w.x * w.y * (a - b - c + e) + s * vec2(at_b + w.y * twist, at_c + w.x * twist));
}
