// Unpolarised Fresnel reflectance of water, index 1.34; c: cosine of incidence in [0, 1]. docs/formulae.md, section 6.
const float INDEX = 1.34;

float fresnel(float c) {
    float q = sqrt(INDEX * INDEX - 1.0 + c * c);
    float a = (q - c) / (q + c);
    float b = (c * (q + c) - 1.0) / (c * (q - c) + 1.0);
    return 0.5 * a * a * (1.0 + b * b);
}
