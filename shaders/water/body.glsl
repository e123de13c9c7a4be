// Light in the water: depth, floor, bubbles.

// @part deep
// Water without a floor: what it scatters back alone.
vec3 water_body(vec3 below, vec3 deep, vec3 extinction, float cv, float height) {
    return deep;
}

// @part floor
// Water over a floor: light goes down and comes back along the refracted ray, absorbed and scattered out on the way.
vec3 water_body(vec3 below, vec3 deep, vec3 extinction, float cv, float height) {
    float slant = refracted_cosine(min(cv, 1.0), INDEX);
    vec3 passed = exp(-extinction * (max(u_floor_depth + height, 0.0) * (1.0 + 1.0 / slant)));
    return mix(deep, u_floor_albedo * below, passed);
}

// @part bubbles
// Bubbles under young foam scatter light back: a layer over the water that is as deep as the foam is young. docs/formulae.md, section 6.
uniform float u_aeration;    // scattering of the bubbles, 1/m
uniform float u_plume_depth; // of the layer where the saturation is 1, m

vec3 aerated(vec3 body, vec3 deep, vec3 below, vec3 extinction, float cv, float f) {
    float layer = u_plume_depth * clamp(f, 0.0, 1.0);
    if (layer <= 0.0) {
        return body;
    }
    // Down, and up along the refracted ray.
    float way = layer * (1.0 + 1.0 / refracted_cosine(min(cv, 1.0), INDEX));
    vec3 milky = 0.4 * (u_scattering + u_aeration) / (extinction + u_aeration) * below;
    // What the water itself would have sent back from the layer makes room.
    vec3 clear = exp(-extinction * way);
    float passed = exp(-u_aeration * way);
    return max(milky * (1.0 - clear * passed) + passed * (body - deep * (1.0 - clear)), 0.0);
}
