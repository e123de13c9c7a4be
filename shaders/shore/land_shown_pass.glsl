// Where land shows: its depth alone, so that neither the water nor the sky is shaded there, nor land elsewhere.
uniform sampler2D u_met; // tau, and what is there: 2 is land
out vec4 o_color;

void main() {
    if (texelFetch(u_met, ivec2(sample_place()), 0).g != 2.0) {
        discard;
    }
    o_color = vec4(0.0);
}
