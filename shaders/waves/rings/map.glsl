// Rings read from the map that the frame drew: exact at its texels, bilinear between them, still water beyond its rim.
uniform sampler2D u_ring_map;
uniform sampler2D u_ring_grain;
uniform vec2 u_ring_corner;  // from the map's corner to the eye, m
uniform float u_ring_side;   // of the map, m

// Beyond the map's rim the nearest texel is read, and that is still.
vec2 rings_uv(vec2 p) {
    return clamp((p + u_ring_corner) / u_ring_side, 0.0, 1.0);
}

// Height and its gradient.
vec3 rings_waves(vec2 p) {
    return textureLod(u_ring_map, rings_uv(p), 0.0).xyz;
}

// Height and gradient without what is smaller than the footprint, and the unresolved mean square slope.
vec4 rings_shading(vec2 p, Footprint fp) {
    vec2 uv = rings_uv(p);
    vec3 here = textureLod(u_ring_map, uv, 0.0).xyz;
    float kept = 1.0;
    float slopes = 0.0;
    if (SURFACE_FILTER) {
        vec4 grain = textureLod(u_ring_grain, uv, 0.0);
        slopes = grain.w;
        vec3 across = vec3(
            fp.x.x * fp.x.x + fp.y.x * fp.y.x,
            2.0 * (fp.x.x * fp.x.y + fp.y.x * fp.y.y),
            fp.x.y * fp.x.y + fp.y.y * fp.y.y);
        // Still water has no grain: 0/0.
        kept = wave_kept(max(dot(grain.xyz, across), 0.0) / max(slopes, 1e-6));
    }
    return vec4(kept * here, (1.0 - kept * kept) * slopes);
}
