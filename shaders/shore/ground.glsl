// Land and sea floor: how high and steep they are at most, and what colour.
uniform float u_shore_top;       // nothing is higher, m
uniform float u_shore_steepest[2]; // slope of the floor, and of what stands over y = 0
uniform float u_shore_bend;      // second derivative of the floor in the square where it turns up, 1/m
uniform float u_shore_swash;     // height that waves reach on the beach, m
uniform float u_shore_plants_from;
uniform float u_shore_reef;
uniform vec3 u_shore_sand;
uniform vec3 u_shore_rock;
uniform vec3 u_shore_plants;

// Grain of what lies there: octaves of noise that fade out before they are smaller than the footprint.
float shore_grain(vec2 q, Footprint fp) {
    float reach = sqrt(max(dot(fp.x, fp.x), dot(fp.y, fp.y)));
    float sum = 0.5;
    float cell = 9.0;
    for (int i = 0; i < 5; ++i) {
        // Each octave is turned against the last (3-4-5), so that no lattice shows.
        q = vec2(0.8 * q.x - 0.6 * q.y, 0.6 * q.x + 0.8 * q.y);
        sum += (noise_value(NOISE_KEY, q / cell) - 0.5) * 0.45 * (1.0 - smoothstep(0.15 * cell, 0.6 * cell, reach));
        cell *= 0.31;
    }
    return clamp(sum, 0.0, 1.0);
}

float shore_wet(float y) {
    return 1.0 - smoothstep(0.5 * u_shore_swash, 1.1 * u_shore_swash + 0.05, y);
}

// Reflectance of the ground: sand, dark where wet; rock where steep; plants higher up; reef and weed under water.
vec3 ground_albedo(vec4 ground, float grain) {
    float steep = length(ground.yz);
    float rocky = smoothstep(0.35, 0.6, steep + 0.25 * (grain - 0.5));
    float grown = smoothstep(u_shore_plants_from, 1.25 * u_shore_plants_from + 0.5, ground.x + 4.0 * (ground.w - 0.5) + 1.5 * (grain - 0.5));
    float reef = u_shore_reef * smoothstep(0.52, 0.6, ground.w + 0.12 * (grain - 0.5)) * smoothstep(0.4, 2.0, -ground.x);
    vec3 albedo = u_shore_sand * (0.8 + 0.4 * grain);
    albedo = mix(albedo, vec3(0.08, 0.085, 0.05) * (0.5 + grain), reef);
    albedo = mix(albedo, u_shore_plants * (0.4 + 1.2 * grain), grown);
    albedo = mix(albedo, u_shore_rock * (0.5 + grain), rocky);
    return albedo * mix(1.0, 0.55, shore_wet(ground.x));
}
