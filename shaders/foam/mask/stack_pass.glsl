// Atlases of several masks over one another, the youngest foam's first.
uniform usampler2D u_mask_atlas_0;
uniform usampler2D u_mask_atlas_1;
uniform usampler2D u_mask_atlas_2; // where there are two masks, the second once more
out uvec2 o_atlas;

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    int which = at.y / MASK_SIZE;
    at.y -= which * MASK_SIZE;
    o_atlas = which == 0 ? texelFetch(u_mask_atlas_0, at, 0).rg
        : which == 1 ? texelFetch(u_mask_atlas_1, at, 0).rg
        : texelFetch(u_mask_atlas_2, at, 0).rg;
}
