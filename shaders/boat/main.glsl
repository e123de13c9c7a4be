// A sample of a boat where it stands before water and land. Linear light, A = 1.
out vec4 o_color;

void main() {
    vec3 ray = camera_ray(gl_FragCoord.xy);
    float size = length(ray);
    vec3 eye = vec3(0.0, u_eye_height, 0.0);
    vec3 d = ray / size;
    float t;
    BoatHit hit;
    int i = trace_boats(eye, d, 0.0, 1e5, false, t, hit);
    if (i < 0) {
        discard;
    }
    float tau;
    vec3 wave;
    if ((find_surface(ray, tau, wave) && tau * size < t) || boat_behind_land(ray, t / size)) {
        discard;
    }
    vec3 light = exposure() * boat_in_air(boat_light(i, eye, d, t, hit), d, t);
    o_color = vec4(min(light, BRIGHTEST), 1.0);
}
