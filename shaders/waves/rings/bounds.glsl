// Bounds of the rings as their map holds them now.
uniform sampler2D u_ring_bounds;

vec3 rings_bounds(vec3 ray, float aside, float from) {
    return texel_at(u_ring_bounds, ivec2(0)).xyz;
}
