// Where this sample lies in the picture, in samples of the picture's grid: blocks of the target hold the samples of chosen
// pixels. docs/formulae.md, section 1.
uniform sampler2D u_chosen_pixels;
uniform vec2 u_target; // pixels

vec2 sample_place() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    at.y = u_chosen.z > 0.0 ? at.y : int(u_target.y) - 1 - at.y;
    int shift = u_chosen.x < 3.0 ? 1 : 2;
    ivec2 block = at >> shift;
    return texelFetch(u_chosen_pixels, block, 0).xy * u_chosen.x + vec2(at - (block << shift)) + 0.5;
}
