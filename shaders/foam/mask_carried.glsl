// Where a point lies on the mask, in tiles: turned, scaled, moved by the eye's place and back along the drift (reduced in float64).
uniform vec4 u_mask_matrix;  // rows of the turn, over the tile's side (1/m)
uniform float u_mask_phase[2]; // rad, a turn is a tile

vec2 mask_turn(vec2 p) {
    return vec2(dot(u_mask_matrix.xy, p), dot(u_mask_matrix.zw, p));
}

vec2 mask_uv(vec2 p) {
    return mask_turn(p) + vec2(u_mask_phase[0], u_mask_phase[1]) / TAU;
}
