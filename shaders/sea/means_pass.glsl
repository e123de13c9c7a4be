// Means of a tile over 2, 4, 8 ... texels along a side: slopes, their square, fold. Levels stand side by side,
// tiles one over the other.
uniform sampler2D u_sea_full_0;
uniform sampler2D u_sea_full_1;
uniform sampler2D u_sea_full_2;
uniform sampler2D u_sea_full_3;
out vec4 o_mean;

vec4 full(int tile, ivec2 at) {
    switch (tile) {
        case 0: return texelFetch(u_sea_full_0, at, 0);
        case 1: return texelFetch(u_sea_full_1, at, 0);
        case 2: return texelFetch(u_sea_full_2, at, 0);
        default: return texelFetch(u_sea_full_3, at, 0);
    }
}

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    int tile = at.y / (SEA_SIZE / 2);
    at.y -= tile * (SEA_SIZE / 2);
    int level = 1;
    int left = 0;
    while (level < SEA_LEVELS && at.x >= left + (SEA_SIZE >> level)) {
        left += SEA_SIZE >> level;
        ++level;
    }
    int side = 1 << level;
    at.x -= left;
    o_mean = vec4(0.0);
    if (max(at.x, at.y) >= SEA_SIZE >> level) {
        return;
    }
    for (int j = 0; j < side; ++j) {
        for (int i = 0; i < side; ++i) {
            vec4 texel = full(tile, side * at + ivec2(i, j));
            o_mean += vec4(texel.yz, dot(texel.yz, texel.yz), texel.w);
        }
    }
    o_mean /= float(side * side);
}
