// Bounds of the rings as their map holds them now.
uniform sampler2D u_ring_bounds;
uniform float u_ring_still; // height of still water, m

vec3 rings_bounds(vec3 ray, float aside) {
    return texelFetch(u_ring_bounds, ivec2(0), 0).xyz + vec3(u_ring_still, 0.0, 0.0);
}
