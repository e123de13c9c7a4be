// One ring around its centre (Kryachko 2005): eta = (I0 e^(-b s) - d) cos(k rho - omega s) between its front and its tail.
// Metres, seconds. rho = sqrt(r^2 + a^2) - a is r with its tip rounded, so nothing is divided by 0 at the centre; s, the age,
// and the way from the centre are reduced in float64. Exact to float32 while omega s < 1e4. docs/formulae.md, section 2.

// way: from the centre, m. now: unused, unused, s, what lies behind the front (m). shape: I0 (m), k (rad/m), omega (rad/s), b (1/s).
// Returns eta, d eta / d rho, 1 / sqrt(r^2 + a^2), and the amplitude here and now.
vec4 ring_profile(vec2 way, vec4 now, vec4 shape) {
    float amplitude = shape.x * exp(-shape.w * now.z) - max(RING_DEAD, RING_DEAD_SHARE * shape.x);
    float wavelength = TAU / shape.y;
    float soft = RING_SOFT * wavelength;
    float square = dot(way, way);
    float far = sqrt(square + soft * soft);
    float rho = square / (far + soft);
    float front = shape.z / shape.y * now.z;
    if (amplitude <= 0.0 || rho >= front) {
        return vec4(0.0, 0.0, 1.0 / far, 0.0);
    }
    float band = 1.0 / (RING_FRONT * wavelength);
    float q = min((front - rho) * band, 1.0);
    float end = front - now.w - 2.0 * RING_FRONT * wavelength;
    float t = clamp((rho - end) * band, 0.0, 1.0);
    float head = q * q * (3.0 - 2.0 * q);
    float tail = t * t * (3.0 - 2.0 * t);
    float change = 6.0 * band * (t * (1.0 - t) * head - q * (1.0 - q) * tail);
    vec2 turn = whole_sine_cosine(wrap_phase(shape.y * rho - shape.z * now.z));
    return vec4(
        amplitude * turn.y * head * tail,
        amplitude * (change * turn.y - shape.y * turn.x * head * tail),
        1.0 / far,
        amplitude * head * tail);
}

// Whether a ring moves the water there: between tail and front, where all else is still.
bool ring_here(vec2 way, vec4 now, vec4 shape) {
    float wavelength = TAU / shape.y;
    float front = shape.z / shape.y * now.z;
    float end = max(front - now.w - 2.0 * RING_FRONT * wavelength, 0.0);
    // rho = x where r^2 = x (x + 2 a).
    float square = dot(way, way);
    return square < front * (front + 2.0 * RING_SOFT * wavelength) && square >= end * (end + 2.0 * RING_SOFT * wavelength);
}

// Position of the lowest bit, 0 where there is none: the exponent of the power of two that it is.
int ring_first(uint bits) {
    return max((floatBitsToInt(float(bits & (~bits + 1u))) >> 23) - 127, 0);
}
