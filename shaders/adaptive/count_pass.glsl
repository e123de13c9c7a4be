// Samples, in fours, that a part of the picture would get at each of four limits. Counted: exact to 2^24.
uniform sampler2D u_contrast;
uniform vec2 u_target; // parts along the picture's sides
out vec4 o_count;

void main() {
    ivec2 picture = textureSize(u_contrast, 0);
    ivec2 size = (picture + ivec2(u_target) - 1) / ivec2(u_target);
    ivec2 first = ivec2(gl_FragCoord.xy) * size;
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
