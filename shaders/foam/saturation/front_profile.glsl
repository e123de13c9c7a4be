// f = E^cot(psi/2) / C, up to 4: the paper's exp(-tan(theta/2 + delta)) / C with its pole moved to psi = 0.
uniform float u_front_intensity; // C
uniform float u_front_log_base;  // ln E

// The half angle's cotangent is (rho + x) / y = y / (rho - x): no tangent to be inaccurate near its pole, and of the two
// forms the one that does not cancel.
float front_profile(vec2 signal, float rho) {
    float exponent;
    if (signal.x > 0.0) {
        exponent = signal.y == 0.0 ? 80.0 : clamp((rho + signal.x) / signal.y, -80.0, 80.0);
    } else {
        exponent = rho > 0.0 ? signal.y / (rho - signal.x) : 0.0;
    }
    return min(exp(u_front_log_base * exponent) / u_front_intensity, 4.0);
}
