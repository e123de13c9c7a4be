// The ground's material: sand, stones and what is wet.

// @part soil_struct
// What a ray sees of land. normal: unit vector of its relief; film: how much of it a film of water mirrors.
struct Soil {
    vec3 normal;
    vec3 albedo;
    float film;
};

// @part soil
// Land in detail: sand with ripples, rock in layers, plants in clumps, what the sea left. Octaves of noise that the footprint hides go
// over into their means. docs/formulae.md, section 8.
uniform float u_land_detail;  // 0 to 1
uniform float u_land_strand;  // height of the line of what the sea left, m

const uint SOIL_KEY = 0x51ED270Bu;   // any number would do
const float SOIL_CELL = 64.0;        // of the first octave, m
const float SOIL_FINER = 0.31;
// Of each octave: share of the pattern (squares sum up to 1), and height of the relief over its cell, on sand, rock and plants.
const vec4 SOIL_OCTAVES[7] = vec4[7](
    vec4(0.30, 0.0, 0.03, 0.02), vec4(0.38, 0.004, 0.06, 0.05), vec4(0.45, 0.008, 0.09, 0.10), vec4(0.45, 0.012, 0.11, 0.14),
    vec4(0.40, 0.018, 0.12, 0.14), vec4(0.35, 0.022, 0.11, 0.10), vec4(0.29, 0.020, 0.08, 0.05));
// Mean of a crack: (1 - 5 |x|)^2 where positive, of a normal x.
const float SOIL_CRACKED = 0.0575;

struct SoilNoise {
    vec4 octaves;   // as seen: of 64 and 20 m together; 6 m; 2 m; finer ones together
    float pattern;  // all, as seen
    float hidden;   // variance of what is not seen of the pattern
    float cracks;
    float strings;  // finer cracks
    vec2 sand;      // slopes of the relief
    vec2 rock;
    vec2 plants;
};

// Adds octaves in a plane: p its coordinates, which change by `along` and `up` a metre of x and z; gain of noise and share of means.
void soil_octaves(vec2 p, vec2 along, vec2 up, uint key, float gain, float share, Footprint fp, inout SoilNoise sum) {
    vec2 side_x = vec2(dot(along, fp.x), dot(up, fp.x));
    vec2 side_y = vec2(dot(along, fp.y), dot(up, fp.y));
    float longer = sqrt(max(dot(side_x, side_x), dot(side_y, side_y)));
    float area = abs(side_x.x * side_y.y - side_x.y * side_y.x);
    // What is a little too fine along the footprint's long side is shown all the same, or grazing views would show nothing.
    float reach = max(area / max(longer, 1e-9), 0.3 * longer);
    vec2 turn = vec2(1.0, 0.0);
    float cells = 1.0 / SOIL_CELL;
    int i = 0;
    for (; i < LAND_OCTAVES; ++i) {
        float kept = 1.0 - smoothstep(0.15, 0.6, reach * cells);
        if (kept <= 0.0) {
            break;
        }
        // Not i itself: compilers would write the loop out as often as the arrays are long.
        vec4 of = SOIL_OCTAVES[min(i, 6)];
        // Each octave is turned against the last (3-4-5), so that no lattice shows.
        turn = vec2(0.8 * turn.x - 0.6 * turn.y, 0.6 * turn.x + 0.8 * turn.y);
        vec3 noise = noise_slopes(key + uint(i), vec2(turn.x * p.x - turn.y * p.y, turn.y * p.x + turn.x * p.y) * cells);
        vec2 slope = vec2(turn.x * noise.y + turn.y * noise.z, turn.x * noise.z - turn.y * noise.y);
        slope = gain * kept * (slope.x * along + slope.y * up);
        float seen = gain * kept * noise.x;
        sum.octaves += seen * vec4(0.7, 1.0, 1.0, 0.6) * vec4(i < 2, i == 2, i == 3, i > 3);
        sum.pattern += of.x * seen;
        sum.hidden -= share * of.x * of.x * kept * kept;
        sum.sand += of.y * slope;
        // Ridges are where the noise changes its sign.
        sum.rock -= of.z * (noise.x * inversesqrt(noise.x * noise.x + 0.04)) * slope;
        sum.plants += of.w * slope;
        float gap = max(1.0 - 5.0 * abs(noise.x), 0.0);
        float crack = share * mix(SOIL_CRACKED, gap * gap, kept);
        sum.cracks += i >= 2 && i <= 4 ? crack : 0.0;
        sum.strings += i >= 5 ? crack : 0.0;
        cells *= 1.0 / SOIL_FINER;
    }
    // Of the others their means.
    sum.cracks += share * SOIL_CRACKED * float(max(min(LAND_OCTAVES, 5) - max(i, 2), 0));
    sum.strings += share * SOIL_CRACKED * float(max(LAND_OCTAVES - max(i, 5), 0));
}

// Noise in the level plane, and on walls in the upright planes along x and z, which would be drawn out otherwise.
SoilNoise soil_noise(vec2 q, vec4 ground, Footprint fp) {
    SoilNoise sum = SoilNoise(vec4(0.0), 0.0, 1.0, 0.0, 0.0, vec2(0.0), vec2(0.0), vec2(0.0));
    vec2 lean = abs(ground.yz);
    float wall = smoothstep(0.8, 1.5, length(lean));
    float over_x = smoothstep(0.4, 0.6, lean.y / max(lean.x + lean.y, 1e-6));
    vec3 share = vec3(1.0 - wall, wall * over_x, wall * (1.0 - over_x));
    vec3 gain = share * inversesqrt(dot(share, share));
    for (int i = 0; i < 3; ++i) {
        if (share[i] > 0.0) {
            vec2 p = i == 0 ? q : vec2(i == 1 ? q.x : q.y, ground.x);
            vec2 along = i == 2 ? vec2(0.0, 1.0) : vec2(1.0, 0.0);
            soil_octaves(p, along, i == 0 ? vec2(0.0, 1.0) : ground.yz, SOIL_KEY + uint(8 * i), gain[i], share[i], fp, sum);
        }
    }
    sum.hidden = max(sum.hidden, 0.0);
    return sum;
}

// Layers of rock: noise along one line, one cell a unit; and its change.
vec2 soil_layer(uint key, float x, float width) {
    float kept = 1.0 - smoothstep(0.15, 0.6, width);
    float base = floor(x);
    float t = x - base;
    int cell = as_int(base);
    float a = noise_share(noise_hash(noise_hash(key) ^ uint(cell)));
    float b = noise_share(noise_hash(noise_hash(key) ^ uint(cell + 1)));
    return kept * vec2(a + (b - a) * t * t * (3.0 - 2.0 * t) - 0.5, (b - a) * 6.0 * t * (1.0 - t));
}

// Mean of smoothstep(low, high, x) over an x of this variance, as of torn foam.
float soil_step(float low, float high, float x, float variance) {
    float middle = 0.5 * (low + high);
    float reach = sqrt(0.25 * (high - low) * (high - low) + 5.0 * variance);
    return smoothstep(middle - reach, middle + reach, x);
}

Soil land_soil(vec2 q, vec4 ground, Footprint fp, vec2 wet) {
    SoilNoise of = soil_noise(q, ground, fp);
    float d = u_land_detail;
    float y = ground.x;
    float steep = length(ground.yz);
    float spread = d * d * of.hidden;

    // Sand: patches, grains, the wind's ripples where it is dry and level.
    float damp = soil_step(0.25, 0.6, wet.x + 0.15 * d * of.pattern * (wet.x < 1.0 ? 1.0 : 0.0), 0.02 * spread);
    float dry = 1.0 - damp;
    vec3 sand = u_shore_sand * max(1.0 + d * (0.06 * of.octaves.x + 0.05 * of.octaves.y + 0.05 * of.octaves.z + 0.11 * of.octaves.w), 0.2);
    vec2 wind = vec2(40.0, 17.0);
    float combed = wave_kept(wind, fp) * dry * smoothstep(-0.6, 1.0, of.octaves.y + 0.5 * of.octaves.x) * (1.0 - smoothstep(0.15, 0.35, steep));
    float turn = wrap_phase(dot(wind, q) + 2.2 * of.octaves.z + 1.2 * of.octaves.w);
    vec2 sand_slope = (1.0 - 0.85 * damp) * of.sand + 0.28 * combed * cos(turn) * normalize(wind);
    sand *= 1.0 + d * 0.08 * combed * sin(turn);

    // Wet sand: darker, and more so the darker it is (Angstrom 1925: light thrown back inside the film).
    vec3 albedo = mix(sand, 0.68 * sand / (1.77 - 0.77 * sand), damp);
    vec2 slope = sand_slope;

    // What the sea left at its highest.
    float strand = (y - u_land_strand) / (0.2 * u_land_strand + 0.02) + 0.5 * of.octaves.y + 0.35 * of.octaves.z;
    float wrack = d * (1.0 - smoothstep(0.0, 1.0, abs(strand))) * min(1.5 * of.strings * smoothstep(0.3, 1.8, 0.6 * of.octaves.z + 1.8 * of.octaves.w), 1.0);
    albedo = mix(albedo, vec3(0.08, 0.06, 0.04), 0.6 * wrack);

    // Rock in layers, cracked.
    vec2 dip = vec2(0.21, -0.13);
    float layer = y + dot(dip, q) + d * (0.9 * of.octaves.x + 0.35 * of.octaves.y + 0.12 * of.octaves.z);
    vec2 across = ground.yz + dip;
    float width = length(vec2(dot(across, fp.x), dot(across, fp.y)));
    vec2 thick = soil_layer(SOIL_KEY + 32u, layer / 7.0, width / 7.0);
    vec2 middle = soil_layer(SOIL_KEY + 33u, layer / 1.7, width / 1.7);
    vec2 thin = soil_layer(SOIL_KEY + 34u, layer / 0.37, width / 0.37);
    float layers = thick.x + middle.x + 0.7 * thin.x;
    vec3 rock = u_shore_rock * max(1.0 + d * (0.75 * layers + 0.16 * of.pattern), 0.15) * (1.0 - d * 0.35 * min(of.cracks * smoothstep(-0.5, 1.2, of.octaves.y + of.octaves.w), 1.0));
    rock *= mix(vec3(1.0), vec3(1.12, 1.0, 0.86), d * clamp(0.8 * thick.x + 0.3 * of.octaves.y, -1.0, 1.0));
    vec2 rock_slope = of.rock - (0.5 * thick.y + 0.5 * middle.y + 0.4 * thin.y) * across;
    // Rock where it is steep with its relief, whose slopes have a variance of 0.45; hidden ones raise mean and variance.
    float rough = min(1.6 * steep, 0.5) * d;
    float rough2 = 0.45 * rough * rough * of.hidden;
    vec2 leaning = ground.yz + rough * of.rock;
    float rocky = soil_step(0.35, 0.6, sqrt(dot(leaning, leaning) + rough2) + 0.3 * min(steep, 0.5) * d * of.pattern, 0.02 * spread + 0.6 * rough2);
    rock *= mix(1.0, 0.5, damp);

    // Plants: clumps, lit on top and dark below, greener or drier by patches; bare soil between.
    float above = y + 4.0 * (ground.w - 0.5) + 1.1 * d * of.pattern;
    float grown = soil_step(u_shore_plants_from, 1.25 * u_shore_plants_from + 0.5, above, 1.2 * spread);
    float clumps = 0.5 * of.octaves.y + 0.7 * of.octaves.z + 0.6 * of.octaves.w;
    float lit = soil_step(-1.4, 1.6, clumps, 0.5 * of.hidden);
    float drier = d * smoothstep(-0.4, 1.6, of.octaves.x + 0.4 * of.octaves.y);
    vec3 green = u_shore_plants * mix(vec3(1.0), vec3(2.3, 1.65, 1.5), drier) * mix(1.0, 0.3 + 1.5 * lit, d);
    float bare = d * soil_step(0.9, 1.7, 0.8 * of.octaves.x - 0.7 * of.pattern, 0.5 * of.hidden);
    vec3 soil = mix(sand, u_shore_rock, 0.6) * 0.75;

    albedo = mix(albedo, mix(green, soil, bare), grown);
    slope = mix(slope, mix(of.plants, 0.5 * of.rock, bare), grown);
    albedo = mix(albedo, rock, rocky);
    slope = mix(slope, rock_slope, rocky);

    // The film stands where the ground is level and dries in patches.
    float film = wet.y * (1.0 - rocky) * (1.0 - grown);
    film = soil_step(0.1, 0.75, film + 0.1 * d * of.pattern * wet.y, 0.01 * spread);
    vec2 leans = ground.yz + d * (1.0 - 0.9 * film) * slope;
    return Soil(normalize(vec3(-leans.x, 1.0, -leans.y)), min(albedo, 0.95), film);
}

// @part splashed
// Land on which drops of spray fall: darker, and a film of water on what of its relief lies as the ground does. docs/formulae.md, section 8.
uniform float u_land_splash; // height up to which it is all wet, m

Soil land_soil(vec2 q, vec4 ground, Footprint fp, vec2 wet) {
    Soil soil = land_soil_dry(q, ground, fp, wet);
    float splashed = 1.0 - smoothstep(u_land_splash, 2.0 * u_land_splash, ground.x);
    vec3 level = normalize(vec3(-ground.y, 1.0, -ground.z));
    // What the swash wetted is dark already.
    soil.albedo *= 1.0 - 0.5 * splashed * (1.0 - smoothstep(0.25, 0.6, wet.x));
    soil.film = max(soil.film, 0.3 * splashed * smoothstep(0.85, 1.0, dot(soil.normal, level)));
    return soil;
}

// @part soil_plain
// Land without detail: smooth, its colours by height and slope.
Soil land_soil(vec2 q, vec4 ground, Footprint fp, vec2 wet) {
    return Soil(normalize(vec3(-ground.y, 1.0, -ground.z)), ground_albedo(ground, shore_grain(q, fp)), wet.y);
}

// @part wet
// How wet the ground is: x how dark, y how much of it mirrors. The last swash wetted it, and since then it dries: the film in seconds,
// the sand in a minute; sand near the water's level stays soaked. docs/formulae.md, section 8.
uniform vec2 u_land_dries; // periods in which film and sand dry to 1/e

vec2 land_wet(vec2 q, float y) {
    vec2 still = vec2(shore_wet(y), 1.0 - smoothstep(0.1 * u_shore_swash, 0.6 * u_shore_swash + 0.03, y));
    if (y > 1.3 * u_shore_swash + 0.2) {
        return still;
    }
    ShoreField f = shore_field(q);
    // How high the ground is, in heights of the wave that ran up it, and how long ago its crest came by.
    float reach = y / max(f.here.g, 1e-3);
    vec2 left = (1.0 - smoothstep(0.8, 1.05, reach)) * exp((shore_turn(f.here.r) - 1.0) / u_land_dries);
    return max(still, vec2(left.y, left.x));
}

// @part wet_still
// How wet the ground is: x how dark, y how much of it mirrors. By its height alone.
vec2 land_wet(vec2 q, float y) {
    return vec2(1.0, 0.6) * shore_wet(y);
}
