// Where a point lies on the mask, in tiles: turned, scaled, and moved by the eye's place (reduced in float64).
uniform vec4 u_mask_matrix; // rows of the turn, over the tile's side (1/m)
uniform vec2 u_mask_offset;

vec2 mask_turn(vec2 p) {
    return vec2(dot(u_mask_matrix.xy, p), dot(u_mask_matrix.zw, p));
}

vec2 mask_uv(vec2 p) {
    return mask_turn(p) + u_mask_offset;
}
