// No clouds.
vec4 clouds(vec3 d, float blur, out float hidden) {
    hidden = 0.0;
    return vec4(0.0);
}
