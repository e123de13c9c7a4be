// Means of a tile over 2, 4, 8 ... texels along a side: slopes, their square, fold. Levels stand side by side,
// tiles one over the other.
uniform sampler2D u_sea_full_0;
uniform sampler2D u_sea_full_1;
uniform sampler2D u_sea_full_2;
uniform sampler2D u_sea_full_3;
out vec4 o_mean;

vec4 sum_of(sampler2D full, ivec2 from, int side) {
    vec4 sum = vec4(0.0);
    for (int j = 0; j < side; ++j) {
        for (int i = 0; i < side; ++i) {
            vec4 texel = texelFetch(full, from + ivec2(i, j), 0);
            sum += vec4(texel.yz, dot(texel.yz, texel.yz), texel.w);
        }
    }
    return sum;
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
    // Drivers without branches go through every case: each is asked once, and three of the loops are over at once.
    ivec2 from = side * at;
    o_mean = sum_of(u_sea_full_0, from, tile == 0 ? side : 0)
        + sum_of(u_sea_full_1, from, tile == 1 ? side : 0)
        + sum_of(u_sea_full_2, from, tile == 2 ? side : 0)
        + sum_of(u_sea_full_3, from, tile == 3 ? side : 0);
    o_mean /= float(side * side);
}
