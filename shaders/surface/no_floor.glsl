// Nothing is told apart under the water.
void look_through(vec2 p, float height, vec3 d, vec3 normal, float lost, Footprint fp) {
}
