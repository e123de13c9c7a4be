// The planar mirror: what an eye as far under still water as ours is over it sees above it, in clip space MIRROR_MARGIN times
// as wide as the picture. RGB light before exposure, in the air; A = 1 / (way from the mirrored eye, m), 0 for sky.
out vec4 o_mirror;

void main() {
    vec2 clip = MIRROR_MARGIN * (2.0 * gl_FragCoord.xy / float(MIRROR_SIZE) - 1.0);
    vec3 ray = u_ray_z + clip.x * u_ray_x + clip.y * u_ray_y;
    vec3 d = normalize(vec3(ray.x, -ray.y, ray.z));
    vec3 eye = vec3(0.0, -u_eye_height, 0.0);
    o_mirror = vec4(0.0);
    // Clipped at still water: the mirrored ray begins where it comes out of it.
    float out_of_water = -eye.y / max(d.y, 1e-6);
    if (d.y < 1e-6 || out_of_water > 1e5) {
        return;
    }
    out_of_water = max(out_of_water, 0.0);
    vec3 o = eye + out_of_water * d;
    vec3 light;
    float t = mirror_met(o, d, true, light);
    if (t >= 0.0) {
        o_mirror = vec4(min(light, BRIGHTEST), 1.0 / max(out_of_water + t, 1e-3));
    }
}
