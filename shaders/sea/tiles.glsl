// What a footprint sees of a tile of sea: mean slopes, their mean square, mean fold.
uniform sampler2D u_sea_means;        // means over more and more texels, a level beside the other, a tile over the other

// Level of the means that a footprint asks for: 0 is the tile itself, above SEA_LEVELS nothing of it is left.
float sea_level(vec3 size, Footprint fp) {
    if (!SURFACE_FILTER) {
        return 0.0;
    }
    float longer = sqrt(max(dot(fp.x, fp.x), dot(fp.y, fp.y)));
    // Held to so many times its width: on a crest's edge a footprint is endlessly long, and nothing of the sea would be left there.
    float width = abs(fp.x.x * fp.y.y - fp.x.y * fp.y.x) / max(longer, 1e-30);
    float texels = min(longer, 4.0 * width) * float(SEA_SIZE) / size.x;
    return clamp(log2(max(texels, 1e-6)), 0.0, float(SEA_LEVELS + 1));
}

vec4 sea_mean(int tile, int level, vec2 at) {
    int size = SEA_SIZE >> level;
    int left = SEA_SIZE - (SEA_SIZE >> (level - 1));
    vec2 place = (fract(at) * float(SEA_SIZE) + 0.5) / float(1 << level) - 0.5;
    vec2 base = floor(place);
    vec2 t = place - base;
    ivec2 corner = ivec2(left, tile * (SEA_SIZE / 2));
    ivec2 near = corner + (ivec2(base) & (size - 1));
    ivec2 far = corner + ((ivec2(base) + 1) & (size - 1));
    vec4 first = mix(texelFetch(u_sea_means, near, 0), texelFetch(u_sea_means, ivec2(far.x, near.y), 0), t.x);
    vec4 second = mix(texelFetch(u_sea_means, ivec2(near.x, far.y), 0), texelFetch(u_sea_means, far, 0), t.x);
    return mix(first, second, t.y);
}

// size: side (m), mean square slope and mean fold of the tile; at: place in it, in tiles.
vec4 sea_seen(sampler2D tile, int number, vec3 size, vec2 at, Footprint fp) {
    float level = sea_level(size, fp);
    vec4 finer;
    if (level < 1.0) {
        vec4 here = sea_smooth(tile, at);
        finer = vec4(here.yz, dot(here.yz, here.yz), here.w);
        if (level <= 0.0) {
            return finer;
        }
    } else {
        finer = sea_mean(number, min(int(level), SEA_LEVELS), at);
    }
    vec4 coarser = int(level) < SEA_LEVELS ? sea_mean(number, int(level) + 1, at) : vec4(0.0, 0.0, size.yz);
    return mix(finer, coarser, level - floor(level));
}

// Mean square slope that is in the footprint and not in its mean slope.
float sea_lost(vec4 seen) {
    return max(seen.z - dot(seen.xy, seen.xy), 0.0);
}
