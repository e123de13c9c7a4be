// How much pixels stand out, and the limits at which so many samples are spent.

// @part contrast
// How far a pixel is from what is round it: an estimate of its error. docs/formulae.md, section 1.
uniform sampler2D u_frame;
out vec4 o_contrast;

// Mean of the channels, rolled off over white: what is far over it differs little on a screen, and by many samples' means.
float roll(vec4 light) {
    float mean = (light.r + light.g + light.b) / 3.0;
    return 3.0 * mean / (2.0 + mean);
}

void main() {
    ivec2 at = as_int(floor(gl_FragCoord.xy));
    ivec2 last = textureSize(u_frame, 0) - 1;
    float here = roll(texelFetch(u_frame, at, 0));
    float cross = here;
    float sum = here;
    float squares = here * here;
    for (int j = -1; j <= 1; ++j) {
        for (int i = -1; i <= 1; ++i) {
            if (i != 0 || j != 0) {
                float there = roll(texelFetch(u_frame, clamp(at + ivec2(i, j), ivec2(0), last), 0));
                cross += i * j == 0 ? there : 0.0;
                sum += there;
                squares += there * there;
            }
        }
    }
    float apart = here - 0.2 * cross;
    float variance = max(squares / 9.0 - sum * sum / 81.0, 0.0);
    o_contrast = vec4(sqrt(apart * apart + 0.5 * variance), 0.0, 0.0, 1.0);
}

// @part count
// Samples, in fours, that a part of the picture would get at each of four limits. Counted: exact to 2^24.
uniform sampler2D u_contrast;
uniform vec2 u_target; // parts along the picture's sides
out vec4 o_count;

void main() {
    ivec2 picture = textureSize(u_contrast, 0);
    ivec2 size = (picture + ivec2(u_target) - 1) / ivec2(u_target);
    ivec2 first = as_int(floor(gl_FragCoord.xy)) * size;
    ivec2 end = min(first + size, picture);
    vec2 tried = limits();
    vec4 limit = tried.x * vec4(1.0, tried.y, tried.y * tried.y, tried.y * tried.y * tried.y);
    bool small = min(picture.x, picture.y) < 24;
    vec4 few = vec4(CHOOSE_FEW ? 1.0 : 0.0);
    vec4 many = (CHOOSE_MANY && !small ? 4.0 : CHOOSE_FEW ? 1.0 : 0.0) - few;
    vec4 ratio = limit * (CHOOSE_FEW ? CHOOSE_RATIO : 1.0);
    vec4 sum = vec4(0.0);
    for (int y = first.y; y < end.y; ++y) {
        for (int x = first.x; x < end.x; ++x) {
            vec4 contrast = vec4(texelFetch(u_contrast, ivec2(x, y), 0).x);
            sum += few * (1.0 - step(contrast, limit)) + many * (1.0 - step(contrast, ratio));
        }
    }
    o_count = sum;
}

// @part limit
// The least of four limits at which the samples stay within the budget, and between which two of them the next four lie.
uniform sampler2D u_counts;
uniform vec2 u_picture; // pixels
uniform float u_eye_height;
uniform float u_surface_top;
uniform vec3 u_ray_x;
uniform vec3 u_ray_y;
uniform vec3 u_ray_z;
out vec4 o_limit;

void main() {
    ivec2 parts = textureSize(u_counts, 0);
    vec4 fours = vec4(0.0);
    // Sky costs next to nothing: the budget is for what is under the horizon.
    float under = 0.0;
    bool low = u_eye_height < u_surface_top;
    for (int y = 0; y < parts.y; ++y) {
        vec4 row = vec4(0.0);
        for (int x = 0; x < parts.x; ++x) {
            row += texelFetch(u_counts, ivec2(x, y), 0);
            vec2 clip = 2.0 * (vec2(x, y) + 0.5) / vec2(parts) - 1.0;
            under += low || u_ray_z.y + clip.x * u_ray_x.y + clip.y * u_ray_y.y < 0.0 ? 1.0 : 0.0;
        }
        fours += row;
    }
    vec2 tried = limits();
    float budget = 0.25 * CHOOSE_BUDGET * u_picture.x * u_picture.y * under / float(parts.x * parts.y);
    float closer = sqrt(sqrt(tried.y));
    vec2 next = vec2(tried.x * tried.y * tried.y * tried.y * closer, closer);
    vec4 at = tried.x * vec4(1.0, tried.y, tried.y * tried.y, tried.y * tried.y * tried.y);
    float limit = 1e9;
    for (int k = 3; k >= 0; --k) {
        if (fours[k] <= budget) {
            limit = at[k];
            // Under the very least none is tried.
            next = LIMITS_FIRST && k == 0 ? vec2(limit, 1.0) : vec2(limit / (closer * closer * closer), closer);
        }
    }
    o_limit = vec4(next, limit, 1.0);
}
