// Points one over the other in the middle of the picture, and one to the left.
void main() {
    float last = step(2.5, float(gl_VertexID));
    gl_Position = vec4(-0.5 * last, 0.0, 0.0, 1.0);
    gl_PointSize = 4.0;
}
