// The flow that carries foam: a steady part, and vortices of Lamb (1932) and Oseen that end at six radii. q: m from the square's
// middle; m/s. Beyond the square the vortices are as at its rim. Exact to float32. docs/formulae.md, section 14.
uniform vec2 u_drift_steady;                   // current and waves' drift, m/s
uniform vec4 u_drift_vortex[DRIFT_VORTICES];   // centre x, z (m), radius (m), angular velocity at the centre (rad/s)

vec2 drift_velocity(vec2 q) {
    vec2 held = clamp(q, -u_drift_half, u_drift_half);
    vec2 sum = u_drift_steady;
    for (int i = 0; i < DRIFT_VORTICES; ++i) {
        vec4 vortex = u_drift_vortex[i];
        vec2 way = held - vortex.xy;
        float square = dot(way, way) / (vortex.z * vortex.z);
        float y = 1.25643121 * square;
        // (1 - e^-y)/y loses its digits, and at the centre all of them: 0/0.
        float share = y < 0.05 ? 1.0 - y * (0.5 - y * (0.166666667 - y * 0.0416666667)) : (1.0 - exp(-min(y, 80.0))) / y;
        share *= 1.0 - smoothstep(DRIFT_REACH_FROM, DRIFT_REACH, sqrt(square));
        sum += vortex.w * share * vec2(-way.y, way.x);
    }
    return sum;
}
