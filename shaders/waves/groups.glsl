// Waves in groups.

// @part factor
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
    uvec2 low = uvec2(as_bits(base) & (GROUP_PERIOD - 1));
    uvec2 high = uvec2((as_bits(base) + 1) & (GROUP_PERIOD - 1));
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

// @part signal
// The sum of a front's own waves, which travel in groups: even_signal is that of waves of one height.
vec2 front_signal(vec2 p, out vec2 by_x, out vec2 by_z) {
    float group = wave_groups(p).x;
    vec2 signal = group * even_signal(p, by_x, by_z);
    by_x *= group;
    by_z *= group;
    return signal;
}

// @part way
// From p to where its water rests, by a front's own waves in groups: even_way is that of waves of one height.
vec2 front_way(vec2 p) {
    return wave_groups(p).x * even_way(p);
}

// @part waves
// Parametric waves that travel in groups: even_waves and even_shading are those of one height, about still water.

// Height and its gradient.
vec3 parametric_waves(vec2 p) {
    vec3 even = even_waves(p);
    vec3 group = wave_groups(p);
    return vec3(group.x * even.x, group.x * even.yz + even.x * group.yz);
}

// Height and gradient without what is smaller than the footprint, and the unresolved mean square slope; groups that are smaller are
// replaced by their mean.
vec4 parametric_shading(vec2 p, Footprint fp) {
    vec4 even = even_shading(p, fp);
    vec3 group = wave_groups(p);
    parametric_signal *= group.x;
    parametric_signal_x *= group.x;
    parametric_signal_z *= group.x;
    parametric_carried *= group.x;
    float square = group.x * group.x;
    if (SURFACE_FILTER) {
        float width = sqrt(max(dot(fp.x, fp.x), dot(fp.y, fp.y)) * dot(u_wave_groups.xy, u_wave_groups.xy));
        float kept = 1.0 - smoothstep(0.5, 2.0, width);
        float mean = 1.0 - 0.5 * u_wave_groups.z;
        group = vec3(mean + kept * (group.x - mean), kept * group.yz);
        square = mix(mean * mean + GROUP_VARIANCE * u_wave_groups.z * u_wave_groups.z, square, kept);
    }
    return vec4(group.x * even.x, group.x * even.yz + even.x * group.yz, square * even.w);
}

// @part front
// Fronts of waves in groups: a front that is none of the waves' own has their factor too.
uniform vec2 u_front_advance; // way of a group past water that drifts, m/rad of the mean phase

// Factor of the waves that passed the water at q, `ago` of the mean phase (rad) before.
float front_group(vec2 q, float ago) {
    return wave_groups(q + u_front_advance * ago).x;
}

// @part fronts
// Single waves of an earlier time that travel in groups: even_fronts is that of waves of one height.
uniform vec2 u_wave_groups_velocity; // m/s

// Height, gradient and rise (m/s) of the waves at a place, age seconds ago.
vec4 fronts_then(vec2 p, float age) {
    vec4 even = even_fronts(p, age);
    vec3 group = wave_groups(p + u_wave_groups_velocity * age);
    return vec4(group.x * even.x, group.x * even.yzw + even.x * vec3(group.yz, -dot(u_wave_groups_velocity, group.yz)));
}

// @part carry
// Where the water at p rests, by waves in groups: even_carry is that of waves of one height.
vec2 parametric_carry(vec2 p) {
    return wave_groups(p).x * even_carry(p);
}
