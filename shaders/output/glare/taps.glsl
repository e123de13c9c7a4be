// Mean of four bilinear readings around a place, texels, each `apart` texels from it along both axes.
vec3 taps(sampler2D image, vec2 at, float apart) {
    vec2 size = vec2(textureSize(image, 0));
    vec3 sum = texture(image, (at + vec2(-apart, -apart)) / size).rgb + texture(image, (at + vec2(apart, -apart)) / size).rgb;
    sum += texture(image, (at + vec2(-apart, apart)) / size).rgb + texture(image, (at + vec2(apart, apart)) / size).rgb;
    return 0.25 * sum;
}

// How much of a level of so many rows counts: those as wide as the picture would veil all of it.
float level_share(float rows) {
    return 1.0 - smoothstep(0.08, 0.25, 1.0 / rows);
}
