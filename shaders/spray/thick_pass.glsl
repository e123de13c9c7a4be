// All drops before a sample: what their water hides by its optical depth, and the mean of its light. Premultiplied.
uniform sampler2D u_spray_thick;
out vec4 o_color;

void main() {
    vec4 sum = textureLod(u_spray_thick, sample_place() / u_viewport, 0.0);
    if (sum.a < 1e-4) {
        discard;
    }
    float cover = 1.0 - exp(-sum.a);
    o_color = vec4(sum.rgb * (cover / sum.a), cover);
}
