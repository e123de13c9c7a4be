// Foam as a lumpy layer of bubbles: two-stream opacity, a matt share, and a share that is scattered once, mostly forward.
// docs/formulae.md, section 6. n, d: unit vectors; f: saturation.
uniform float u_foam_depth;   // optical depth where the saturation is 1
uniform float u_foam_lumps;   // 2/pi of the mean square slope of its lumps
uniform float u_foam_forward; // share of the sun's light that is scattered once

// Mean cosine, or 0 where it is negative, over the lumps of a surface of mean cosine c.
float lumpy_cosine(float c) {
    return max(0.5 * (c + sqrt(c * c + u_foam_lumps)), 1e-3);
}

vec4 foam_layer(vec3 n, vec3 d, float f) {
    float eye = lumpy_cosine(-dot(n, d));
    float sun = lumpy_cosine(dot(n, u_sun_direction));
    float depth = u_foam_depth * clamp(f, 0.0, 1.0);
    float opacity = depth / (depth + 2.0 * eye);
    // 1 + G^2 - 2 G gamma is at least (1 - G)^2, so the power stays finite
    float apart = max(1.0 + FOAM_ASYMMETRY * FOAM_ASYMMETRY - 2.0 * FOAM_ASYMMETRY * dot(d, u_sun_direction),
        (1.0 - FOAM_ASYMMETRY) * (1.0 - FOAM_ASYMMETRY));
    float once = FOAM_PHASE / (apart * sqrt(apart) * (sun + eye));
    vec3 lit = u_sun_irradiance * (sun_past_foam.y * sun * mix(1.0 / PI, once, u_foam_forward))
        + u_sky_irradiance * ((0.5 + 0.5 * n.y) / PI);
    return vec4(foam_albedo() * opacity * lit, opacity);
}
