// Foam that ends in a cell, added up.
flat in vec4 v_foam;
out vec4 o_drift;

void main() {
    o_drift = v_foam;
}
