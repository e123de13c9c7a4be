// Groups of waves: a factor of their heights, of value noise that travels with their group velocity. docs/formulae.md, section 2.
// The noise is a hash and no texture: a sea with whitecaps leaves no sampler free.
uniform vec2 u_wave_groups_place[1]; // the place under the eye, cells modulo GROUP_PERIOD
uniform vec3 u_wave_groups;          // along the groups' way, cells/m; contrast

// A corner in [0, 1]: a quarter of them are 0, a quarter 1.
float group_corner(uint word) {
    return clamp(2.0 * noise_share(noise_hash(word)) - 0.5, 0.0, 1.0);
}

// The factor, in [1 - contrast, 1], and its gradient, 1/m.
vec3 wave_groups(vec2 p) {
    vec2 along = u_wave_groups.xy;
    vec2 place = vec2(dot(along, p), along.x * p.y - along.y * p.x) + u_wave_groups_place[0];
    vec2 base = floor(place);
    uvec2 low = uvec2(ivec2(base) & (GROUP_PERIOD - 1));
    uvec2 high = uvec2((ivec2(base) + 1) & (GROUP_PERIOD - 1));
    uint left = noise_hash(uint(GROUP_KEY) ^ low.x);
    uint right = noise_hash(uint(GROUP_KEY) ^ high.x);
    vec2 near = vec2(group_corner(left ^ low.y), group_corner(left ^ high.y));
    vec2 rise = vec2(group_corner(right ^ low.y), group_corner(right ^ high.y)) - near;
    vec2 t = place - base;
    vec2 w = t * t * (3.0 - 2.0 * t);
    vec2 across = near + w.x * rise;
    vec2 slope = 6.0 * u_wave_groups.z * t * (1.0 - t) * vec2(rise.x + w.y * (rise.y - rise.x), across.y - across.x);
    float noise = across.x + w.y * (across.y - across.x);
    return vec3(1.0 - u_wave_groups.z * (1.0 - noise), slope.x * along + slope.y * vec2(-along.y, along.x));
}
