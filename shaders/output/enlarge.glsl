// A picture that is drawn at a part of its width, enlarged: Catmull and Rom's cubic (1974) along the rows, within the two pixels that it
// lies between, so that no edge has a rim. Of light as it is seen, below 1 however bright: a glint is one bright pixel to its neighbours
// and not a thousand. A, foam's coverage, alike.

uniform sampler2D u_narrow;
uniform vec2 u_viewport;
out vec4 o_color;

vec4 seen(int column, int row) {
    vec4 drawn = texel_at(u_narrow, ivec2(clamp(column, 0, textureSize(u_narrow, 0).x - 1), row));
    vec3 light = max(drawn.rgb, 0.0);
    return vec4(light / (1.0 + max(light.r, max(light.g, light.b))), drawn.a);
}

void main() {
    float x = gl_FragCoord.x / u_viewport.x * float(textureSize(u_narrow, 0).x) - 0.5;
    int column = int(floor(x));
    int row = int(gl_FragCoord.y);
    float f = x - floor(x);
    vec4 left = seen(column, row);
    vec4 right = seen(column + 1, row);
    vec4 weights = f * vec4(-0.5 + f * (1.0 - 0.5 * f), f * (-2.5 + 1.5 * f), 0.5 + f * (2.0 - 1.5 * f), f * (-0.5 + 0.5 * f));
    vec4 sum = weights.x * seen(column - 1, row) + (1.0 + weights.y) * left + weights.z * right + weights.w * seen(column + 2, row);
    vec4 found = clamp(sum, min(left, right), max(left, right));
    o_color = vec4(min(found.rgb / max(1.0 - max(found.r, max(found.g, found.b)), 1e-4), BRIGHTEST), found.a);
}
