// A drop: where it is now, whether it is seen, how large and how bright. What is not there lies beyond the picture.
uniform float u_spray_size;  // m
uniform float u_spray_mist;
uniform float u_spray_drag;  // s
flat out vec4 v_light;       // light, opacity of the middle
flat out vec3 v_disc;        // middle and radius, samples

void main() {
    gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
    gl_PointSize = 1.0;
    v_light = vec4(0.0);
    v_disc = vec3(0.0);
    vec3 birth;
    vec3 velocity;
    float age;
    uint word;
    if (!spray_born(gl_VertexID, birth, velocity, age, word)) {
        return;
    }
    bool mist = spray_part(word, 5u) < u_spray_mist;
    float vary = spray_part(word, 6u);
    // Mist rides on the air that the burst has set in motion: it slows down as drops do and hardly falls.
    vec3 drop = spray_flight(birth, velocity, age, u_spray_drag * (0.6 + 0.8 * vary), mist ? 1.5 : 9.81);
    drop.y -= u_eye_height;
    float depth = dot(drop, u_ray_z);
    vec2 clip = vec2(dot(drop, u_ray_x) / dot(u_ray_x, u_ray_x), dot(drop, u_ray_y) / dot(u_ray_y, u_ray_y)) / max(depth, 0.1);
    // Points whose middle is outside are cut by some drivers and drawn by others.
    if (depth < 0.3 || any(greaterThan(abs(clip), vec2(1.0))) || spray_hidden(drop, depth)) {
        return;
    }
    float radius = u_spray_size * SPRAY_WIDER * (mist ? 9.0 * (0.35 + vary) * (0.3 + age) : 0.3 + 1.2 * vary * vary * vary);
    float opacity = (mist ? 0.045 : 0.9) * smoothstep(0.0, 0.05, age) * (1.0 - smoothstep(0.4, 1.0, age / u_spray_life));
    opacity *= smoothstep(0.3, 1.0, depth);
    radius *= 0.5 * u_viewport.y / (length(u_ray_y) * depth);
    // Less than a sample and a half wide: as wide, and thinner.
    float wide = clamp(radius, 0.75, 124.0);
    opacity *= min(radius * radius / (wide * wide), 1.0);
    float away = length(drop);
    v_light = vec4(spray_light(drop / away, away), opacity);
    v_disc = vec3((0.5 * clip + 0.5) * u_viewport, wide);
    gl_Position = vec4(clip, 0.0, 1.0);
    gl_PointSize = 2.0 * wide + 2.0;
}
