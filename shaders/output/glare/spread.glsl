// Glare: a share of the light spreads, in equal parts over levels that each reach twice as far, so that it falls with the inverse
// square of the angle as in eye and lens (Vos 1984). docs/formulae.md, section 7.
uniform sampler2D u_glare; // the sum of the levels
uniform float u_glare_share;

vec3 with_glare(vec3 light) {
    float rows = float(textureSize(u_glare, 0).y);
    float levels = 1.0;
    for (int k = GLARE_LEVELS - 1; k > 0; --k) {
        levels = 1.0 + level_share(ceil(rows / exp2(float(k)))) * levels;
    }
    vec3 spread = texture(u_glare, 0.25 * gl_FragCoord.xy / vec2(textureSize(u_glare, 0))).rgb;
    return light + u_glare_share / float(GLARE_LEVELS) * (spread - levels * light);
}
