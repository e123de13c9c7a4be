// Mean of m and of m^2 over a square of 2^level texels, trilinear, from half floats by the sampler.
uniform sampler2D u_mask_moments;

vec2 mask_moments(vec2 uv, float level) {
    return textureLod(u_mask_moments, uv, level).rg;
}
