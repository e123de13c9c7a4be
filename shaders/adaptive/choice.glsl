// Which pixels get more samples: their kinds, the choice among them and its limits.

// @part bits
// How many of the lower 16 bits are set.
int bits(int x) {
    x -= (x >> 1) & 0x5555;
    x = (x & 0x3333) + ((x >> 2) & 0x3333);
    x = (x + (x >> 4)) & 0x0f0f;
    return (x + (x >> 8)) & 0x1f;
}

vec2 bits(vec2 both) {
    return vec2(bits(int(both.x)), bits(int(both.y)));
}

// @part kind
// The two kinds of chosen pixels, of 4 and of 16 samples: how each fills a target twice as wide and high as the picture.
// x: samples along a pixel's side, 2 or 4. y: rows of the target a row of blocks. z: 1, rows from below, or -1, from above.
uniform vec3 u_chosen;

float chosen_total(vec2 both) {
    return u_chosen.x < 3.0 ? both.x : both.y;
}

// Blocks in a row.
int chosen_columns(int width) {
    return u_chosen.x < 3.0 ? width : width >> 1;
}

// @part place
// Where this sample lies in the picture, in samples of the picture's grid: blocks of the target hold the samples of chosen
// pixels, no two in a row or column of one. docs/formulae.md, section 1.
uniform sampler2D u_chosen_pixels;
uniform vec2 u_target; // pixels

vec2 sample_place() {
    ivec2 at = as_int(floor(gl_FragCoord.xy));
    at.y = u_chosen.z > 0.0 ? at.y : int(u_target.y) - 1 - at.y;
    int shift = u_chosen.x < 3.0 ? 1 : 2;
    ivec2 block = at >> shift;
    vec2 within = vec2(at - (block << shift));
    vec2 turned = vec2(within.y + 0.5, u_chosen.x - 0.5 - within.x) / u_chosen.x;
    return texelFetch(u_chosen_pixels, block, 0).xy * u_chosen.x + within + turned;
}

// @part choice
// What a pixel of this contrast gets from a limit on: nothing (0), 4 samples (1) or 16 (2). docs/formulae.md, section 1.
int choice(float contrast, float limit, ivec2 picture) {
    // Blocks of 16 samples leave gaps in small targets.
    bool many = CHOOSE_MANY && min(picture.x, picture.y) >= 24 && contrast > (CHOOSE_FEW ? CHOOSE_RATIO : 1.0) * limit;
    return many ? 2 : CHOOSE_FEW && contrast > limit ? 1 : 0;
}

// @part first_limits
// The limits that are tried at first: the least, and the ratio of each to the one before.
const bool LIMITS_FIRST = true;

vec2 limits() {
    return vec2(CHOOSE_LEAST, CHOOSE_STEP);
}

// @part next_limits
// The limits that are tried next: the least, and the ratio of each to the one before.
uniform sampler2D u_limits;
const bool LIMITS_FIRST = false;

vec2 limits() {
    return texelFetch(u_limits, ivec2(0), 0).xy;
}
