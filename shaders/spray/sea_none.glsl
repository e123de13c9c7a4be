// No sea from a spectrum.
float sea_breaks(inout vec2 p, int batch) {
    return 0.0;
}

float sea_then(vec2 p, int batch) {
    return 0.0;
}
