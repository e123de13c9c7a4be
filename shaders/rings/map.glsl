// Rings read from the map that the frame drew: exact at its texels, bilinear between them, still water beyond its rim.
uniform sampler2D u_ring_map;
uniform vec2 u_ring_corner;  // from the map's corner to the eye, m
uniform float u_ring_side;   // of the map, m
uniform float u_ring_level;  // height of still water, m
uniform float u_ring_common; // the rings' usual wavenumber, rad/m

vec4 rings_texel(vec2 p) {
    vec2 uv = (p + u_ring_corner) / u_ring_side;
    bool inside = all(greaterThan(uv, vec2(0.0))) && all(lessThan(uv, vec2(1.0)));
    return inside ? textureLod(u_ring_map, uv, 0.0) : vec4(0.0);
}

// Height and its gradient.
vec3 rings_waves(vec2 p) {
    return rings_texel(p).xyz + vec3(u_ring_level, 0.0, 0.0);
}

// Height and gradient with what is smaller than the footprint taken out, and the mean square slope taken out.
vec4 rings_shading(vec2 p, Footprint fp) {
    vec4 here = rings_texel(p);
    float kept = 1.0;
    if (SURFACE_FILTER) {
        float k = u_ring_common;
        kept = exp(-0.0625 * min(k * k * (dot(fp.x, fp.x) + dot(fp.y, fp.y)), 1200.0));
    }
    return vec4(u_ring_level + kept * here.x, kept * here.yz, (1.0 - kept * kept) * here.w);
}
