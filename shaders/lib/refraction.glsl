// Refraction and reflection at the surface of water, seen from the air. docs/formulae.md, sections 6 and 11.
const float INDEX = 1.34; // refractive index of water, visible light

// Snell's law: cosine of the refracted ray to the normal, in a medium of this index. c: cosine of incidence, at most 1.
float refracted_cosine(float c, float index) {
    return sqrt(1.0 - (1.0 - c * c) / (index * index));
}

// Refracted direction. d, n: unit vectors, incident direction and normal; c: cosine of incidence, -dot(n, d).
vec3 refracted(vec3 d, vec3 n, float c, float index) {
    return d / index + (c / index - refracted_cosine(c, index)) * n;
}

// Fresnel reflectance of unpolarised light; c: cosine of incidence in [0, 1].
float fresnel(float c) {
    float q = sqrt(INDEX * INDEX - 1.0 + c * c);
    // Both polarisations over one divisor.
    float s = c * (q - c) + 1.0;
    float p = c * (q + c) - 1.0;
    float a = (q - c) / ((q + c) * s);
    return 0.5 * a * a * (s * s + p * p);
}
