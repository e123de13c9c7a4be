// Maps of a coast: distance to the shore, when waves arrive, how they are refracted.

// @part around
// The same; g: in a cell and the eight round it, where beams no wider than a cell on either side meet nothing higher; b, a: heights from
// which the sun is seen.
uniform sampler2D u_land_cells;
out vec4 o_highest;

void main() {
    ivec2 cell = as_int(floor(gl_FragCoord.xy));
    ivec2 level = land_level(cell.x);
    ivec2 low = ivec2(level.y, 0);
    ivec2 high = low + level.x - 1;
    float highest = 0.0;
    for (int j = -1; j <= 1; ++j) {
        for (int i = -1; i <= 1; ++i) {
            highest = max(highest, texelFetch(u_land_cells, clamp(cell + ivec2(i, j), low, high), 0).r);
        }
    }
    // Half floats round by less.
    vec2 sunlit = level.x == LAND_CELLS ? sunlit_from(cell) : vec2(0.0);
    o_highest = vec4(1.001 * vec2(texelFetch(u_land_cells, cell, 0).r, highest), sunlit);
}

// @part blur
// Gaussian smoothing along one side of the map.
uniform vec2 u_viewport;
uniform sampler2D u_rough;
uniform vec2 u_blur_side;     // (1, 0) or (0, 1)
uniform float u_shore_spread; // standard deviation, texels, at most SPREAD_REACH/3
out vec4 o_smooth;

void main() {
    ivec2 here = as_int(floor(gl_FragCoord.xy));
    ivec2 last = textureSize(u_rough, 0) - 1;
    vec4 sum = vec4(0.0);
    float weights = 0.0;
    for (int i = -SPREAD_REACH; i <= SPREAD_REACH; ++i) {
        // No smoothing at all is a Gaussian of a hundredth of a texel: 0/0 is kept out.
        float x = float(i) / max(u_shore_spread, 0.01);
        float weight = exp(-0.5 * min(x * x, 160.0));
        sum += weight * texelFetch(u_rough, clamp(here + i * ivec2(u_blur_side), ivec2(0), last), 0);
        weights += weight;
    }
    o_smooth = sum / weights;
}

// @part seed
// First step of the distance map: a texel on land is its own nearest land, one at sea its own nearest sea.
// rg: nearest land, ba: nearest sea, in texels; -1: none known.
uniform vec2 u_viewport;
out vec4 o_nearest;

void main() {
    vec2 at = floor(gl_FragCoord.xy);
    bool land = shore_floor(((at + 0.5) / u_viewport - 0.5) * u_shore_size).x >= 0.0;
    o_nearest = land ? vec4(at, -1.0, -1.0) : vec4(-1.0, -1.0, at);
}

// @part flood
// A step of jump flooding (Rong and Tan 2006): of what the nine texels `u_flood_step` apart know, keep the nearest.
// A step of 1 goes before the halving steps (1+JFA, Rong and Tan 2007). rg: nearest land, ba: nearest sea; -1: none.
uniform sampler2D u_nearest;
uniform float u_flood_step;
out vec4 o_nearest;

float away(vec2 found, vec2 at) {
    return found.x < 0.0 ? 1e9 : dot(found - at, found - at);
}

void main() {
    ivec2 here = as_int(floor(gl_FragCoord.xy));
    ivec2 last = textureSize(u_nearest, 0) - 1;
    vec2 at = vec2(here);
    vec4 best = vec4(-1.0);
    vec2 least = vec2(1e9);
    for (int j = -1; j <= 1; ++j) {
        for (int i = -1; i <= 1; ++i) {
            vec4 found = texelFetch(u_nearest, clamp(here + int(u_flood_step) * ivec2(i, j), ivec2(0), last), 0);
            float land = away(found.xy, at);
            float sea = away(found.zw, at);
            if (land < least.x) {
                least.x = land;
                best.xy = found.xy;
            }
            if (sea < least.y) {
                least.y = sea;
                best.zw = found.zw;
            }
        }
    }
    o_nearest = best;
}

// @part distance
// Distance to the nearest point of the opposite kind (Outerra 2011), m: positive at sea, negative on land; r. The coast
// lies half a texel off the texels along it. Depth of the floor, m; g. Without any coast: as far as the square is wide.
uniform vec2 u_viewport;
uniform sampler2D u_nearest;
out vec4 o_distance;

void main() {
    vec2 at = floor(gl_FragCoord.xy);
    vec4 found = texelFetch(u_nearest, ivec2(at), 0);
    float height = shore_floor(((at + 0.5) / u_viewport - 0.5) * u_shore_size).x;
    bool land = height >= 0.0;
    vec2 other = land ? found.zw : found.xy;
    float texels = other.x < 0.0 ? u_viewport.x : length(other - at) - 0.5;
    o_distance = vec4((land ? -texels : texels) * u_shore_size / u_viewport.x, -height, 0.0, 1.0);
}

// @part map_begin
// Parameters of the map of what shore waves need to know of a place, and its smooth distances. docs/formulae.md, section 8.
uniform vec2 u_viewport;
uniform sampler2D u_smooth;       // distance (m, positive at sea), depth (m)
uniform float u_shore_size;       // m
uniform float u_shore_deep;       // m
uniform float u_shore_slope;
uniform float u_shore_shelter;    // radius of a lagoon's ring, m; 0: none
uniform float u_surf_height;      // m
uniform float u_surf_period;      // s
uniform float u_surf_variation;
uniform vec2 u_surf_heading;      // unit vector
uniform float u_surf_exposure;
uniform vec2 u_surf_mask[4];      // wavevectors of the mask, rad/m
uniform float u_surf_mask_phase[4];

vec2 smoothed(ivec2 texel) {
    return texel_at(u_smooth, clamp(texel, ivec2(0), textureSize(u_smooth, 0) - 1)).rg;
}

float smooth_between(float low, float high, float x) {
    float t = clamp((x - low) / max(high - low, 1e-6), 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}

// @part arrives_normal
// Waves reach every coast at normal incidence. phase (periods); how much of their height is left where two coasts are as near, and on
// coasts that face away.
vec3 shore_arrival(ivec2 here, float d, vec2 g) {
    float steep = length(g);
    float ridge = smooth_between(0.3, 0.8, steep);
    float met = dot(-g / max(steep, 1e-6), u_surf_heading);
    float exposed = mix(1.0, smooth_between(-0.3, 0.7, met), u_surf_exposure);

    // Time to shore over the period, at the speed sqrt(g h) over a floor of even slope.
    float least = max(0.3 * u_surf_height, 0.05);
    float root = sqrt(least);
    float beyond = sqrt(least + u_shore_slope * max(d, 0.0));
    float phase = (2.0 * max(d, 0.0) / (root + beyond) + min(d, 0.0) / root) / (sqrt(9.81) * u_surf_period);
    return vec3(phase, ridge, exposed);
}

// @part arrives_refracted
// A swell whose crests are lines of equal travel time: phase (periods); how much of its height islands leave, and 1.
uniform sampler2D u_shore_travel; // arrival (periods), share of the height

vec3 shore_arrival(ivec2 here, float d, vec2 g) {
    vec2 travel = texel_at(u_shore_travel, here).rg;
    return vec3(-travel.r, travel.g, 1.0);
}

// @part map
// What shore waves need to know of a place: r phase (periods), g height (m), b skew (row of the table, 0 to 1), a how much of
// the open sea's waves is left. docs/formulae.md, section 8.
out vec4 o_map;

void main() {
    ivec2 here = as_int(floor(gl_FragCoord.xy));
    vec2 q = (gl_FragCoord.xy / u_viewport - 0.5) * u_shore_size;
    vec2 at = smoothed(here);
    float d = at.x;
    float depth = at.y;

    // Sobel's gradient of the distance: points out to sea; short where coasts on two sides are as near.
    vec2 g = vec2(0.0);
    for (int i = -1; i <= 1; ++i) {
        float weight = i == 0 ? 2.0 : 1.0;
        g.x += weight * (smoothed(here + ivec2(1, i)).x - smoothed(here + ivec2(-1, i)).x);
        g.y += weight * (smoothed(here + ivec2(i, 1)).x - smoothed(here + ivec2(i, -1)).x);
    }
    g *= u_viewport.x / (8.0 * u_shore_size);
    vec3 arrival = shore_arrival(here, d, g);
    float open = u_shore_shelter > 0.0 ? smooth_between(0.85 * u_shore_shelter, 1.1 * u_shore_shelter, length(q)) : 1.0;

    float breaks = max(u_surf_height, 0.05) / 0.78;
    float shoal = depth >= breaks ? sqrt(sqrt(breaks / max(depth, breaks))) : 0.3 + 0.7 * smooth_between(0.0, breaks, depth);
    float far = 1.0 - smooth_between(0.45 * u_shore_deep, 0.9 * u_shore_deep, depth);
    float inland = smooth_between(-1.2 * max(u_surf_height, 0.05) / u_shore_slope, 0.0, d);
    float sum = 0.0;
    for (int i = 0; i < 4; ++i) {
        sum += sin(wrap_phase(u_surf_mask_phase[i] + dot(u_surf_mask[i], q)));
    }
    float rhythm = 1.0 - u_surf_variation * smooth_between(-0.8, 0.8, 0.5 * sum);

    o_map = vec4(
        arrival.x,
        u_surf_height * shoal * far * inland * arrival.y * arrival.z * open * rhythm,
        1.0 - smooth_between(breaks, 2.5 * breaks, depth),
        smooth_between(0.0, 0.6 * u_shore_deep, depth) * mix(0.1, 1.0, open));
}

// @part share
// What is left of the open sea's waves in a texel of the map: the polynomial that its quadratic B-spline is there.
uniform sampler2D u_shore_map;
out vec4 o_share;

float share_at(ivec2 texel) {
    return texel_at(u_shore_map, clamp(texel, ivec2(0), textureSize(u_shore_map, 0) - 1)).a;
}

vec3 share_powers(vec3 taps) {
    return vec3(0.5 * (taps.x + taps.y), taps.y - taps.x, 0.5 * (taps.x - 2.0 * taps.y + taps.z));
}

void main() {
    ivec2 here = as_int(floor(gl_FragCoord.xy));
    ivec2 texel = ivec2(here.x / 3, here.y);
    int power = here.x - 3 * texel.x;
    vec3 rows[3];
    for (int i = 0; i < 3; ++i) {
        vec3 taps;
        for (int j = 0; j < 3; ++j) {
            taps[j] = share_at(texel + ivec2(i - 1, j - 1));
        }
        rows[i] = share_powers(taps);
    }
    o_share = vec4(share_powers(vec3(rows[0][power], rows[1][power], rows[2][power])), 1.0);
}
