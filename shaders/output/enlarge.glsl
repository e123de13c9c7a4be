// A picture that is drawn at a part of its width, at full width.

// @part enlarged
// Rows that are shifted against one another: Catmull and Rom's cubic (1974) along them, within the two pixels that it lies between, so
// that no edge has a rim; and a share of the rows above and below. Lines of pixels four wide hold no shape that a cubic would find. Of
// light as it is seen, below 1 however bright: a glint is one bright pixel to its neighbours and not a thousand. A, foam's coverage,
// alike.
uniform sampler2D u_samples;

vec4 seen(int column, int row) {
    vec4 drawn = texel_at(u_samples, ivec2(clamp(column, 0, textureSize(u_samples, 0).x - 1), row));
    vec3 light = max(drawn.rgb, 0.0);
    return vec4(light / (1.0 + max(light.r, max(light.g, light.b))), drawn.a);
}

vec4 between(float x, int row) {
    int column = as_int(floor(x));
    float f = x - floor(x);
    vec4 left = seen(column, row);
    vec4 right = seen(column + 1, row);
    if (PIXEL_WIDTH > 3.0) {
        return mix(left, right, f);
    }
    vec4 weights = f * vec4(-0.5 + f * (1.0 - 0.5 * f), f * (-2.5 + 1.5 * f), 0.5 + f * (2.0 - 1.5 * f), f * (-0.5 + 0.5 * f));
    vec4 sum = weights.x * seen(column - 1, row) + (1.0 + weights.y) * left + weights.z * right + weights.w * seen(column + 2, row);
    return clamp(sum, min(left, right), max(left, right));
}

vec4 enlarged() {
    ivec2 size = textureSize(u_samples, 0);
    int row = as_int(floor(gl_FragCoord.y));
    float middle = gl_FragCoord.x / u_viewport.x * float(size.x) - 0.5;
    float shift = (row & 1) == 0 ? -ROW_SHIFT : ROW_SHIFT;
    vec4 found = between(middle - shift, row);
    if (ROWS_SHARE > 0.0) {
        // The first row has none below, the last none above: that on the other side.
        int above = row + 1 < size.y ? row + 1 : max(row - 1, 0);
        int below = row > 0 ? row - 1 : above;
        int beside = as_int(floor(middle + shift + 0.5));
        float f = fract(middle - shift);
        // Of dots as much where the two beside differ; where they are alike, a crest may run between the rows.
        float alike = PIXEL_WIDTH > 3.0 ? 0.4 : 0.1;
        float share = DOTTED ? mix(alike, ROWS_SHARE, 4.0 * found.a * (1.0 - found.a)) : ROWS_SHARE;
        found = mix(found, 0.5 * (seen(beside, above) + seen(beside, below)), share * 4.0 * f * (1.0 - f));
    }
    return vec4(min(found.rgb / max(1.0 - max(found.r, max(found.g, found.b)), 1e-4), BRIGHTEST), found.a);
}
