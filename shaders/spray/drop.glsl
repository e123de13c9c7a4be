// A drop's disc, thinner toward its rim. Premultiplied light.
flat in vec4 v_light;
flat in vec3 v_disc;
out vec4 o_color;

void main() {
    vec2 away = (gl_FragCoord.xy - v_disc.xy) / v_disc.z;
    float within = max(1.0 - dot(away, away), 0.0);
    float cover = v_light.a * within * within;
    o_color = vec4(v_light.rgb * cover, cover);
}
