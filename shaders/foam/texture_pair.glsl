// Two copies of the foam texture on tiles without a common measure, the second with u and v swapped (Vlachos), so that they never
// align: their mean. Trilinear, levels from the longer side of the footprint.
uniform sampler2D u_foam_texture;
uniform vec2 u_foam_offset;        // the eye's place, in tiles
uniform float u_foam_tile;         // 1/m
uniform vec2 u_foam_second_offset;
uniform float u_foam_second_tile;

float foam_texture(vec2 p, Footprint fp) {
    float reach = sqrt(max(dot(fp.x, fp.x), dot(fp.y, fp.y))) * float(FOAM_TEXTURE_SIZE);
    float first_level = max(log2(max(reach * u_foam_tile, 1e-6)), 0.0);
    float second_level = max(log2(max(reach * u_foam_second_tile, 1e-6)), 0.0);
    float first = textureLod(u_foam_texture, p * u_foam_tile + u_foam_offset, first_level).r;
    vec2 swapped = (p * u_foam_second_tile + u_foam_second_offset).yx;
    return 0.5 * (first + textureLod(u_foam_texture, swapped, second_level).r);
}
