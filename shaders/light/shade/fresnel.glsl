// Unpolarised Fresnel reflectance of water, index 1.34; c: cosine of incidence in [0, 1]. docs/formulae.md, section 6.
const float INDEX = 1.34;

float fresnel(float c) {
    float q = sqrt(INDEX * INDEX - 1.0 + c * c);
    // Both polarisations over one divisor.
    float s = c * (q - c) + 1.0;
    float p = c * (q + c) - 1.0;
    float a = (q - c) / ((q + c) * s);
    return 0.5 * a * a * (s * s + p * p);
}
