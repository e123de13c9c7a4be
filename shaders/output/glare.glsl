// Light that the eye spreads.

// @part taps
// Mean of four bilinear readings around a place, texels, each `apart` texels from it along both axes. A: how many levels count.
vec4 taps(sampler2D image, vec2 at, float apart) {
    vec2 size = vec2(textureSize(image, 0));
    vec4 sum = texture(image, (at + vec2(-apart, -apart)) / size) + texture(image, (at + vec2(apart, -apart)) / size);
    sum += texture(image, (at + vec2(-apart, apart)) / size) + texture(image, (at + vec2(apart, apart)) / size);
    return 0.25 * sum;
}

// How much of a level of so many rows counts: those as wide as the picture would veil all of it.
float level_share(float rows) {
    return 1.0 - smoothstep(0.08, 0.25, 1.0 / rows);
}

// @part mean
// Mean of the finished frame over a block of 4 x 4 pixels, each at most so bright.
uniform sampler2D u_linear;

vec3 block_mean(ivec2 block, float most) {
    ivec2 last = textureSize(u_linear, 0) - 1;
    vec3 sum = vec3(0.0);
    for (int j = 0; j < 4; ++j) {
        for (int i = 0; i < 4; ++i) {
            sum += min(texel_at(u_linear, min(4 * block + ivec2(i, j), last)).rgb, most);
        }
    }
    return sum / 16.0;
}

// @part mean_narrow
// The same of a frame that is not enlarged yet: of what is drawn of its rows.
uniform sampler2D u_samples;

vec3 block_mean(ivec2 block, float most) {
    ivec2 last = textureSize(u_samples, 0) - 1;
    vec3 sum = vec3(0.0);
    for (int j = 0; j < 4; ++j) {
        for (int i = 0; i < BLOCK_COLUMNS; ++i) {
            vec2 pixel = vec2(4 * block + ivec2(0, j)) + vec2((float(i) + 0.5) * (4.0 / float(BLOCK_COLUMNS)), 0.5);
            ivec2 drawn = min(as_int(floor(pixel * vec2(1.0 / PIXEL_WIDTH, 1.0))), last);
            sum += min(over_narrow(texel_at(u_samples, drawn), pixel).rgb, most);
        }
    }
    return sum / float(4 * BLOCK_COLUMNS);
}

// @part first
// What spreads of the finished frame: means of 4 x 4 pixels. docs/formulae.md, section 7.
out vec4 o_color;

// Light that a sum of levels still holds in a half float; a pixel so bright is white at any exposure.
const float GLARE_MOST = 4096.0;

void main() {
    o_color = vec4(block_mean(as_int(floor(gl_FragCoord.xy)), GLARE_MOST), 1.0);
}

// @part half
// The next level, half as fine: weights 1, 3, 3, 1 along both axes.
uniform sampler2D u_finer;
out vec4 o_color;

void main() {
    o_color = taps(u_finer, 2.0 * gl_FragCoord.xy, 0.75);
}

// @part add
// A coarser level with all that were added to it, onto the next finer one.
uniform sampler2D u_coarser;
out vec4 o_color;

void main() {
    float share = level_share(float(textureSize(u_coarser, 0).y));
    o_color = share * taps(u_coarser, 0.5 * gl_FragCoord.xy, 0.5);
}

// @part spread
// Glare: a share of the light spreads, in equal parts over levels that each reach twice as far, so that it falls with the inverse
// square of the angle as in eye and lens (Vos 1984). docs/formulae.md, section 7.
uniform sampler2D u_glare; // the sum of the levels; A: how many count
uniform float u_glare_share;

vec3 with_glare(vec3 light) {
    vec4 spread = texture(u_glare, 0.25 * gl_FragCoord.xy / vec2(textureSize(u_glare, 0)));
    return light + u_glare_share / float(GLARE_LEVELS) * (spread.rgb - spread.a * light);
}
