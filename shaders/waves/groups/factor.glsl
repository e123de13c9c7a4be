// Groups of waves: a factor of their heights that travels with their group velocity. docs/formulae.md, section 2.
uniform sampler2D u_wave_groups;      // n in [-1, 1] and its gradient per side of the tile
uniform vec2 u_wave_groups_offset[1]; // the place under the eye in the tile, in tiles
uniform vec2 u_wave_groups_scale;     // 1 over the side (1/m); half the contrast

// The factor, in [1 - contrast, 1], and its gradient, 1/m.
vec3 wave_groups(vec2 p) {
    vec3 field = textureLod(u_wave_groups, p * u_wave_groups_scale.x + u_wave_groups_offset[0] + 0.5 / float(GROUP_TEXELS), 0.0).xyz;
    return vec3(1.0 - u_wave_groups_scale.y * (1.0 - field.x), u_wave_groups_scale.x * u_wave_groups_scale.y * field.yz);
}
