// Sky and land as seen from a metre over the water, or over the ground, right under the eye. docs/formulae.md, section 10.
const float AROUND_HEIGHT = 1.0; // m

vec3 surroundings(vec3 r, vec3 spread) {
    vec2 eye = shore_place(vec2(0.0));
    float height = max(AROUND_HEIGHT, shore_floor(eye).x + AROUND_HEIGHT);
    float tau;
    vec4 ground;
    return land_along(eye, height, r, tau, ground) ? land_seen(eye, r, tau, ground) : mirrored_sky(r, spread);
}
