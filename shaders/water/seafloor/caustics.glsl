// The sun's light on the floor, focused by the ripples: the caustic map, over the light on a level surface. Read bilinearly;
// under a footprint (`surface.filter`) the mean of four places in it, and even light where it holds whole figures of light.
uniform sampler2D u_caustics;
uniform vec2 u_caustic_place; // the eye's place in the tile, less the way of the light down to the floor, in tiles
uniform float u_caustic_tile; // m

const float CAUSTIC_FIGURE = 0.5; // width of a figure of light, m

vec3 caustic_at(vec2 at) {
    return textureLod(u_caustics, at / u_caustic_tile + u_caustic_place, 0.0).rgb;
}

vec3 bed_sunlight(vec2 at, Footprint fp) {
    if (!SURFACE_FILTER) {
        return caustic_at(at);
    }
    vec3 sum = caustic_at(at + 0.25 * (fp.x + fp.y)) + caustic_at(at + 0.25 * (fp.x - fp.y))
        + caustic_at(at - 0.25 * (fp.x + fp.y)) + caustic_at(at - 0.25 * (fp.x - fp.y));
    float reach = (dot(fp.x, fp.x) + dot(fp.y, fp.y)) / (CAUSTIC_FIGURE * CAUSTIC_FIGURE);
    return mix(vec3(1.0), 0.25 * sum, exp(-min(reach, 80.0)));
}
