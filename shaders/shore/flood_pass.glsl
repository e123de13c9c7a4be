// A step of jump flooding (Rong and Tan 2006): of what the nine texels `u_flood_step` apart know, keep the nearest.
// A step of 1 goes before the halving steps (1+JFA, Rong and Tan 2007). rg: nearest land, ba: nearest sea; -1: none.
uniform sampler2D u_nearest;
uniform float u_flood_step;
out vec4 o_nearest;

float away(vec2 found, vec2 at) {
    return found.x < 0.0 ? 1e9 : dot(found - at, found - at);
}

void main() {
    ivec2 here = ivec2(gl_FragCoord.xy);
    ivec2 last = textureSize(u_nearest, 0) - 1;
    vec2 at = vec2(here);
    vec4 best = vec4(-1.0);
    vec2 least = vec2(1e9);
    for (int j = -1; j <= 1; ++j) {
        for (int i = -1; i <= 1; ++i) {
            vec4 found = texelFetch(u_nearest, clamp(here + int(u_flood_step) * ivec2(i, j), ivec2(0), last), 0);
            float land = away(found.xy, at);
            float sea = away(found.zw, at);
            if (land < least.x) {
                least.x = land;
                best.xy = found.xy;
            }
            if (sea < least.y) {
                least.y = sea;
                best.zw = found.zw;
            }
        }
    }
    o_nearest = best;
}
