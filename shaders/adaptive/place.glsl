// Where this sample lies in the picture, in samples of the picture's grid: blocks of the target hold the samples of chosen
// pixels, no two in a row or column of one. docs/formulae.md, section 1.
uniform sampler2D u_chosen_pixels;
uniform vec2 u_target; // pixels

vec2 sample_place() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    at.y = u_chosen.z > 0.0 ? at.y : int(u_target.y) - 1 - at.y;
    int shift = u_chosen.x < 3.0 ? 1 : 2;
    ivec2 block = at >> shift;
    vec2 within = vec2(at - (block << shift));
    vec2 turned = vec2(within.y + 0.5, u_chosen.x - 0.5 - within.x) / u_chosen.x;
    return texelFetch(u_chosen_pixels, block, 0).xy * u_chosen.x + within + turned;
}
