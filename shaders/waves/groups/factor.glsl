// Groups of waves: a factor of their heights, of value noise that travels with their group velocity. docs/formulae.md, section 2.
uniform vec2 u_wave_groups_place[1]; // the place under the eye, cells modulo 256
uniform vec3 u_wave_groups;          // along the groups' way, cells/m; contrast

// In [0, 1]: a quarter of the corners are 0, a quarter 1.
float group_corner(uint word) {
    return clamp(2.0 * noise_share(noise_hash(word)) - 0.5, 0.0, 1.0);
}

// Value noise in [0, 1] and its derivatives per cell.
vec3 group_noise(vec2 place) {
    vec2 base = floor(place);
    vec2 t = place - base;
    vec2 w = t * t * (3.0 - 2.0 * t);
    vec2 d = 6.0 * t * (1.0 - t);
    ivec2 cell = ivec2(base);
    uint near = noise_hash(uint(GROUP_SEED) ^ uint(cell.x & 255));
    uint far = noise_hash(uint(GROUP_SEED) ^ uint((cell.x + 1) & 255));
    uint low = uint(cell.y & 255);
    uint high = uint((cell.y + 1) & 255);
    float a = group_corner(near ^ low);
    float b = group_corner(far ^ low) - a;
    float c = group_corner(near ^ high) - a;
    float e = group_corner(far ^ high) - a - b - c;
    return vec3(a + b * w.x + c * w.y + e * w.x * w.y, d.x * (b + e * w.y), d.y * (c + e * w.x));
}

// The factor, in [1 - contrast, 1], and its gradient, 1/m.
vec3 wave_groups(vec2 p) {
    vec2 along = u_wave_groups.xy;
    vec3 noise = group_noise(vec2(dot(along, p), along.x * p.y - along.y * p.x) + u_wave_groups_place[0]);
    vec2 slope = u_wave_groups.z * noise.yz;
    return vec3(1.0 - u_wave_groups.z * (1.0 - noise.x), slope.x * along + slope.y * vec2(-along.y, along.x));
}
