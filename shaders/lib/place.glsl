// Where this sample lies in the picture, in samples of the picture's grid. docs/formulae.md, section 1.
vec2 sample_place() {
    return gl_FragCoord.xy;
}
