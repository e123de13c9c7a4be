// Bounds of the rings as their map holds them now, over the level of waves/rings/map.glsl.
uniform sampler2D u_ring_bounds;

vec3 rings_bounds(vec3 ray, float aside, float from) {
    return texelFetch(u_ring_bounds, ivec2(0), 0).xyz + vec3(u_ring_level, 0.0, 0.0);
}
