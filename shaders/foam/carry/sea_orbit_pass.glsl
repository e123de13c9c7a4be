// From each second corner of a tile to where the water that is there rests, m. Two tiles over one another, a pass for each; each with
// its first row once more at its end, so that bilinear reads need no wrap there.
void main() {
    int side = SEA_SIZE / 2;
    ivec2 at = ivec2(gl_FragCoord.xy);
    int row = at.y / (side + 1);
    if (row != int(u_sea_block)) {
        discard;
    }
    vec2 corner = 2.0 * vec2(at.x, (at.y - row * (side + 1)) & (side - 1));
    o_tile = vec4(u_sea_texel * (resting(corner) - corner), 0.0, 0.0);
}
