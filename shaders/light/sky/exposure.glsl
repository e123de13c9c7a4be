// Exposure as a factor on linear light.
uniform float u_exposure; // stops

float exposure() {
    return exp2(u_exposure);
}
