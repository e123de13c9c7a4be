// A front's phase, and what the eye sees of it. docs/formulae.md, section 4.
uniform float u_front_relief; // slope amplitude of the sinusoid that is as steep as the waves

// How fast the phase of a sum of waves changes along x and z, rad/m. signal: the sum; by_x, by_z: its derivatives.
vec2 front_gradient(vec2 signal, vec2 by_x, vec2 by_z) {
    return vec2(signal.x * by_x.y - signal.y * by_x.x, signal.x * by_z.y - signal.y * by_z.x) / max(dot(signal, signal), 1e-4);
}

// Waves hide their backs from a ray that falls by less than they do. psi and width: the phases under the footprint; out: those
// of them that the eye sees. along: how fast psi grows along the view, rad/m; across: in any direction.
// Of a sinusoid whose slope is q times exceeded the eye sees the phases from q past its crest to sqrt(4 pi q) before it (parabolas at
// the crests), which tends to all of them where q is 1. Footprints wider than this arc take it whole.
void front_seen(vec2 p, float height, float along, float across, inout float psi, inout float width) {
    float over = u_eye_height - height;
    float relief = u_front_relief * abs(along);
    float q = min(abs(over) * across / max(relief * length(p), 1e-20), 1.0);
    float before = sqrt(2.0 * TAU * q);
    float q4 = q * q * q * q;
    float q16 = q4 * q4 * q4 * q4;
    float arc = max((q + before) / max(1.0 - q16, 1e-6), 1e-5);
    float crest = over < 0.0 ? FRONT_CREST - PI : FRONT_CREST;
    float middle = crest + (along < 0.0 ? 0.5 : -0.5) * (before - q);
    psi = wrap_phase(psi + smoothstep(1.0, 2.0, width / arc) * wrap_phase(middle - psi));
    width = min(width, arc);
}
