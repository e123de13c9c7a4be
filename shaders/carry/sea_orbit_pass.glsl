// From each second corner of a tile to where the water that is there rests, m.
void main() {
    vec2 corner = 2.0 * floor(gl_FragCoord.xy);
    o_tile = vec4(u_sea_texel * (resting(corner) - corner), 0.0, 0.0);
}
