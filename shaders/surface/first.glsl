// What a ray from the eye meets first, at ray * tau: WATER, with its height and gradient in `wave`, LAND over y = 0, with `ground`, or 0.
const int WATER = 1;
const int LAND = 2;

int first_met(vec3 ray, out float tau, out vec3 wave, out vec4 ground) {
    float land_tau;
    bool dry = find_land_ahead(ray, land_tau, ground);
    // Land first: no water is looked for under it.
    float farthest = dry ? land_tau : 1e30;
    bool wet = find_surface(ray, farthest, tau, wave) && tau <= farthest;
    tau = dry && !wet ? land_tau : tau;
    return wet ? WATER : dry ? LAND : 0;
}
