// A drop's quadrilateral: along its flight as the eye sees it, as long as it moves in a moment. What is not seen has no area.
uniform sampler2D u_spray_air;
out vec2 v_at;             // place in it, its rim at length 1
flat out vec3 v_scattered;
flat out vec3 v_onward;
flat out vec3 v_sun;       // toward the sun: along the flight, across, toward the eye
flat out vec4 v_strands;   // first place in the texture, texels over half the length, level
flat out float v_fine;      // share of the finer strands
flat out vec3 v_form;      // optical depth of the middle, share that is covered there, softness of the strands

void main() {
    int i = gl_VertexID / 6;
    gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
    v_at = vec2(0.0);
    v_scattered = vec3(0.0);
    v_onward = vec3(0.0);
    v_sun = vec3(0.0);
    v_strands = vec4(0.0);
    v_form = vec3(0.0);
    v_fine = 0.0;
    vec4 air = spray_entry(u_spray_air, i, 0);
    if (air.w <= 0.0) {
        return;
    }
    vec4 thrown = spray_entry(u_spray_births, i, 1);
    vec4 traits = spray_entry(u_spray_births, i, 2);
    uint word = uint(traits.z);
    float vary = spray_part(word, 6u);
    float age = spray_entry(u_spray_births, i, 0).w;
    vec2 fall = spray_fall(traits.y, vary);
    vec3 velocity = spray_speed(thrown.xyz, age, fall.x, fall.y);
    SprayForm form = spray_form(traits.y, age - spray_delay(traits.y, spray_part(word, 8u)), traits.w, vary, spray_part(word, 9u));
    float depth = dot(air.xyz, u_ray_z);
    vec2 squares = vec2(dot(u_ray_x, u_ray_x), dot(u_ray_y, u_ray_y));
    vec2 clip = vec2(dot(air.xyz, u_ray_x), dot(air.xyz, u_ray_y)) / (squares * depth);
    vec2 moves = (vec2(dot(velocity, u_ray_x), dot(velocity, u_ray_y)) / squares - clip * dot(velocity, u_ray_z)) / depth;
    moves *= 0.5 * u_viewport * (SPRAY_WIDER * form.moment);
    // Samples: half the width, and half the length.
    vec4 scattered = spray_entry(u_spray_air, i, 1);
    float unit = 0.5 * u_viewport.y / length(u_ray_y);
    float scale = unit / depth;
    // No larger than its height over the surface lets it be: what is drawn below would stand before the water.
    float radius = thrown.w * form.radius;
    float wide = min(radius, 0.5 * radius + scattered.w) * scale;
    float longer = length(moves) * min(scattered.w / max(abs(velocity.y) * form.moment, 1e-3), 1.0);
    vec2 along = length(moves) > 1e-4 ? normalize(moves) : vec2(0.0, 1.0);
    vec2 size = vec2(wide + min(longer, form.longest * wide), wide);
    // Narrower than a sample and a half: as wide, and hides as much.
    vec2 drawn = max(size, 0.75);
    float thin = size.x * size.y / (drawn.x * drawn.y);
    v_at = quad_corner();
    vec2 place = v_at.x * drawn.x * along + v_at.y * drawn.y * vec2(-along.y, along.x);
    v_scattered = scattered.rgb;
    v_onward = spray_entry(u_spray_air, i, 2).rgb;
    v_sun = spray_sunward(along);
    float texels = 0.5 * SPRAY_WINDOW * float(SPRAY_STRANDS);
    float sharp = log2(texels / drawn.y);
    float level = clamp(sharp, 0.0, 5.0);
    float window = 0.5 * SPRAY_WINDOW;
    v_strands = vec4(spray_part(word, 10u), spray_part(word, 11u), window * min(drawn.x / drawn.y, 2.0), level);
    v_fine = 1.0 - clamp((sharp + 2.0) / 2.0, 0.0, 1.0);
    // What spans so much of the view is a cloud that the eye is in.
    float around = traits.y == SPRAY_COLUMN ? 0.0 : smoothstep(0.06, 0.2, size.x / unit);
    float opacity = traits.x * air.w * smoothstep(0.3, 1.0, depth) * (1.0 - around);
    float hides = 1.0 - exp(-form.depth * opacity);
    v_form = vec3(-log(1.0 - min(thin * hides, 0.999)), form.cover, mix(form.soft, 1.0, level / 5.0));
    gl_Position = vec4(clip + 2.0 * place / u_viewport, 0.0, 1.0);
}
