// The same between the texels of a target of half the picture's size, by the sampler.
uniform sampler2D u_sky_air;

vec4 exposed_air(vec3 d) {
    return textureLod(u_sky_air, sample_place() / u_viewport, 0.0);
}
