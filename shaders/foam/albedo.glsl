// Share of light that foam scatters back.
uniform float u_foam_albedo;

float foam_albedo() {
    return u_foam_albedo;
}
