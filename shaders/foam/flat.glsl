// Foam without a thickness.
void foam_relief(float f, float amount, vec2 p, Footprint fp) {
}
