// Foam has a thickness: toward the sun, as far away as its shade is long, is there foam too? It would take the sun from the water here,
// and an edge that looks at the sun is brighter for having none. docs/formulae.md, section 6.
uniform float u_foam_thickness; // m

void foam_relief(float f, float amount, vec2 p, Footprint fp) {
    if (f <= 0.0) {
        return;
    }
    // A low sun's shade ends after four thicknesses.
    vec2 way = u_foam_thickness / max(u_sun_direction.y, 0.25) * u_sun_direction.xz;
    float x = length(fp.x);
    float y = length(fp.y);
    // Far away edges and shades are too fine to be told apart.
    float near = 1.0 - smoothstep(0.25, 1.0, max(x, y) / max(length(way), 1e-6));
    if (near <= 0.0) {
        return;
    }
    // Soft: over half a thickness.
    Footprint soft = Footprint(max(1.0, 0.5 * u_foam_thickness / max(x, 1e-6)) * fp.x, max(1.0, 0.5 * u_foam_thickness / max(y, 1e-6)) * fp.y);
    // Foam so thin lets through and scatters on what it does not send back.
    near *= FOAM_SHADE;
    float beside = near * min(beside_amount(f, p, way, soft), 1.0);
    sun_past_foam = vec2(1.0 - beside, 1.0 + near * min(amount, 1.0) - beside);
}
