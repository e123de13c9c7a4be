// Groups of waves: a factor of their heights, of value noise that travels with their group velocity. docs/formulae.md, section 2.
uniform usampler2D u_wave_groups_corners; // of each cell, 16 bits each
uniform vec2 u_wave_groups_place[1];      // the place under the eye, cells modulo GROUP_PERIOD
uniform vec4 u_wave_groups;               // along the groups' way, cells/m; contrast, and its 65535th part

// The factor, in [1 - contrast, 1], and its gradient, 1/m.
vec3 wave_groups(vec2 p) {
    vec2 along = u_wave_groups.xy;
    vec2 place = vec2(dot(along, p), along.x * p.y - along.y * p.x) + u_wave_groups_place[0];
    vec2 base = floor(place);
    uvec2 corners = texelFetch(u_wave_groups_corners, ivec2(base) & (GROUP_PERIOD - 1), 0).rg;
    vec2 t = place - base;
    vec2 w = t * t * (3.0 - 2.0 * t);
    vec2 near = vec2(corners & 65535u);
    vec2 rise = vec2(corners >> 16u) - near;
    vec2 across = near + w.x * rise;
    vec2 slope = 6.0 * u_wave_groups.w * t * (1.0 - t) * vec2(rise.x + w.y * (rise.y - rise.x), across.y - across.x);
    float noise = across.x + w.y * (across.y - across.x);
    return vec3(1.0 - u_wave_groups.z + u_wave_groups.w * noise, slope.x * along + slope.y * vec2(-along.y, along.x));
}
