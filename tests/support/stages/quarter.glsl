// A quarter of white, half covering.
out vec4 o_color;

void main() {
    o_color = vec4(vec3(0.25), 0.5);
}
