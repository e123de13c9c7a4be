// Optical depth of a drop's water at a sample, and its light times that: depths add up in any order.
uniform sampler2D u_spray_strands; // ranks: low on the strands, lowest at their beads
in vec2 v_at;
flat in vec3 v_scattered;
flat in vec3 v_onward;
flat in vec3 v_sun;
flat in vec4 v_strands;
flat in vec3 v_form;
flat in float v_fine;
out vec4 o_thick;

void main() {
    float square = dot(v_at, v_at);
    if (square >= 1.0) {
        discard;
    }
    float within = 1.0 - square;
    vec2 way = v_at * vec2(v_strands.z, 0.5 * SPRAY_WINDOW);
    float rank = textureLod(u_spray_strands, v_strands.xy + way, v_strands.w).r;
    float cover = clamp((v_form.y * within - rank) / v_form.z + 0.5, 0.0, 1.0);
    // Near the eye strands are drops themselves: the same ranks, SPRAY_FINER times finer and turned.
    if (v_fine > 0.0) {
        float fine = textureLod(u_spray_strands, v_strands.yx + SPRAY_FINER * vec2(way.y, -way.x), v_strands.w + log2(SPRAY_FINER)).r;
        cover = mix(cover, clamp((cover - fine) / 0.3 + 0.5, 0.0, 1.0), v_fine);
    }
    if (cover <= 0.0) {
        discard;
    }
    float depth = v_form.x * within * cover;
    float facing = 0.75 + 0.25 * dot(vec3(v_at, sqrt(within)), v_sun);
    o_thick = vec4((v_scattered * facing + v_onward * exp(-1.5 * depth)) * depth, depth);
}
