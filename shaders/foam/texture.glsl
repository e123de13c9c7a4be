// The foam texture, trilinear, its level from the longer side of the footprint.
uniform sampler2D u_foam_texture;
uniform vec2 u_foam_offset; // the eye's place, in tiles
uniform float u_foam_tile;  // 1/m

float foam_texture(vec2 p, Footprint fp) {
    float texels = sqrt(max(dot(fp.x, fp.x), dot(fp.y, fp.y))) * u_foam_tile * float(FOAM_TEXTURE_SIZE);
    float level = max(log2(max(texels, 1e-6)), 0.0);
    return textureLod(u_foam_texture, p * u_foam_tile + u_foam_offset, level).r;
}
