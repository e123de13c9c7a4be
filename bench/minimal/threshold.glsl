#version 300 es
// Preset paper-threshold by hand: a level plane, the front of one flat wave, equation 1.
precision highp float;
precision highp int;
precision highp usampler2D;

uniform vec2 u_viewport;
uniform float u_eye_height;
uniform vec3 u_ray_x;
uniform vec3 u_ray_y;
uniform vec3 u_ray_z;
uniform vec4 u_front_wave[1];
uniform float u_front_phase[1];
uniform float u_front_intensity;
uniform vec4 u_mask_matrix;
uniform vec2 u_mask_offset;
uniform usampler2D u_mask_ranks;
out vec4 o_color;

void main() {
    vec2 clip = 2.0 * gl_FragCoord.xy / u_viewport - 1.0;
    vec3 ray = u_ray_z + clip.x * u_ray_x + clip.y * u_ray_y;
    if (ray.y >= 0.0) {
        discard;
    }
    vec2 p = (u_eye_height / -ray.y) * ray.xz;
    float psi = u_front_phase[0] - dot(u_front_wave[0].xy, p);
    float n = floor(psi * 0.159154943091895 + 0.5);
    psi = (psi - n * 6.28125) - n * 1.93530717958648e-3;
    float f = exp(clamp(cos(0.5 * psi) / sin(0.5 * psi), -80.0, 80.0)) / u_front_intensity;
    vec2 uv = vec2(dot(u_mask_matrix.xy, p), dot(u_mask_matrix.zw, p)) + u_mask_offset;
    uint rank = texelFetch(u_mask_ranks, ivec2(floor(uv * 512.0)) & 511, 0).r;
    o_color = vec4(f > (float(rank) + 0.5) / 65536.0 ? 1.0 : 0.0);
}
