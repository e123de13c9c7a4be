// Caustics: photons, where they land, and the map of them.

// @part landing
// Where the sun's light lands that enters the water at a corner of the grid. docs/formulae.md, section 11.
uniform sampler2D u_caustic_slopes;
uniform vec3 u_sun_direction;
uniform float u_caustic_index; // of refraction, of this colour
uniform float u_caustic_depth; // m
uniform vec2 u_caustic_flat;   // where light lands under level water, m
uniform float u_caustic_tile;  // m

// x, y: how far beside the place where light lands under level water, m; z: light over that on level water.
vec3 caustic_landing(ivec2 corner, int corners) {
    vec2 slope = texel_at(u_caustic_slopes, corner % corners).xy;
    vec3 n = normalize(vec3(-slope.x, 1.0, -slope.y));
    float c = max(dot(n, u_sun_direction), 0.0);
    vec3 ray = refracted(-u_sun_direction, n, c, u_caustic_index);
    // No ripple may tilt the ray level, and a sun on the horizon lights none by itself.
    vec2 way = ray.xz * (u_caustic_depth / max(-ray.y, 0.25));
    return vec3(way - u_caustic_flat, c / (n.y * max(u_sun_direction.y, 0.05)));
}

// @part slopes
// Slopes of the ripples where sunlight enters: at the corners of the grid, which close on themselves at the tile's ends.
uniform vec2 u_viewport;
uniform vec4 u_caustic_wave[CAUSTIC_WAVES]; // k.x, k.z (rad/m), slope, unused
uniform float u_caustic_phase[CAUSTIC_WAVES];
uniform float u_caustic_tile;               // m
out vec4 o_slopes;

void main() {
    vec2 p = floor(gl_FragCoord.xy) / u_viewport * u_caustic_tile;
    vec2 slope = vec2(0.0);
    for (int i = 0; i < CAUSTIC_WAVES; ++i) {
        vec3 wave = u_caustic_wave[i].xyz;
        slope -= wave.z * normalize(wave.xy) * whole_sine_cosine(wrap_phase(u_caustic_phase[i] - dot(wave.xy, p))).y;
    }
    o_slopes = vec4(slope, 0.0, 0.0);
}

// @part fold
// The caustic map from photons: four sums a colour, and what they left on the rim belongs to the tile's other side.
uniform sampler2D u_caustic_red;
uniform sampler2D u_caustic_green;
uniform sampler2D u_caustic_blue;
out vec4 o_light;

void main() {
    ivec2 at = as_int(floor(gl_FragCoord.xy));
    vec3 sum = vec3(0.0);
    for (int j = -1; j <= 1; ++j) {
        for (int i = -1; i <= 1; ++i) {
            ivec2 from = at + CAUSTIC_RIM + ivec2(i, j) * CAUSTIC_TEXELS;
            if (all(greaterThanEqual(from, ivec2(0))) && all(lessThan(from, ivec2(CAUSTIC_TEXELS + 2 * CAUSTIC_RIM)))) {
                sum.r += dot(texel_at(u_caustic_red, from), vec4(1.0));
                sum.g += dot(texel_at(u_caustic_green, from), vec4(1.0));
                sum.b += dot(texel_at(u_caustic_blue, from), vec4(1.0));
            }
        }
    }
    o_light = vec4(sum, 0.0);
}

// @part grid_vertex
// A corner of the refracted grid, drawn where its light lands, at half texels. The grid reaches past the tile by
// CAUSTIC_MARGIN cells.
// A corner is the last of two triangles, the provoking one: it brings them their areas, for derivatives of a varying would
// hang on how finely a driver places corners.
in vec2 a_grid;
out vec2 v_entered;        // column where it entered, in cells; light
flat out vec3 v_triangles; // area where it entered over area here of the triangle after this corner's column and before; the column

const float CAUSTIC_MOST = 12.0; // a triangle folded to nothing would be infinitely bright

vec3 landing_of(ivec2 corner) {
    vec3 landing = caustic_landing(corner + 2 * CAUSTIC_CELLS, CAUSTIC_CELLS);
    return vec3(vec2(corner) + landing.xy * (float(CAUSTIC_CELLS) / u_caustic_tile), landing.z);
}

float spread(vec2 a, vec2 b) {
    return 1.0 / max(abs(a.x * b.y - a.y * b.x), 1.0 / CAUSTIC_MOST);
}

void main() {
    ivec2 corner = as_int(floor(a_grid * float(CAUSTIC_CELLS + 2 * CAUSTIC_MARGIN) + 0.5)) - CAUSTIC_MARGIN;
    vec3 here = landing_of(corner);
    vec2 before = landing_of(corner - ivec2(0, 1)).xy;
    vec2 after = landing_of(corner + ivec2(1, -1)).xy;
    vec2 left = landing_of(corner - ivec2(1, 0)).xy;
    v_entered = vec2(float(corner.x), here.z);
    v_triangles = vec3(spread(before - here.xy, after - here.xy), spread(before - here.xy, left - here.xy), float(corner.x));
    vec2 place = here.xy * (float(2 * CAUSTIC_TEXELS) / float(CAUSTIC_CELLS)) + float(CAUSTIC_RIM);
    gl_Position = vec4(place / float(CAUSTIC_TEXELS + CAUSTIC_RIM) - 1.0, 0.0, 1.0);
}

// @part grid
// Light of a refracted triangle: its area where it entered over its area here, added where triangles overlap.
uniform vec3 u_caustic_channels; // 1 in those of its colour
in vec2 v_entered;
flat in vec3 v_triangles;
out vec4 o_light;

void main() {
    float ratio = v_entered.x >= v_triangles.z ? v_triangles.x : v_triangles.y;
    o_light = vec4(ratio * v_entered.y * u_caustic_channels, 0.0);
}

// @part photon_vertex
// A photon of a regular grid, counted where it lands in the tile.
flat out vec3 v_photon; // texel where it lands; light
flat out vec4 v_part;   // which of four sums it joins

void main() {
    ivec2 corner = ivec2(gl_VertexID % CAUSTIC_PHOTONS, gl_VertexID / CAUSTIC_PHOTONS);
    vec3 landing = caustic_landing(corner, CAUSTIC_PHOTONS);
    vec2 place = fract(vec2(corner) / float(CAUSTIC_PHOTONS) + landing.xy / u_caustic_tile);
    vec2 texel = place * float(CAUSTIC_TEXELS) + float(CAUSTIC_RIM);
    float share = float(CAUSTIC_TEXELS) / float(CAUSTIC_PHOTONS);
    v_photon = vec3(texel, landing.z * share * share);
    // Half floats round at every addition: four sums of a quarter each round a quarter as much.
    ivec2 odd = corner & 1;
    v_part = vec4(equal(ivec4(odd.x + 2 * odd.y), ivec4(0, 1, 2, 3)));
    gl_PointSize = 4.0;
    gl_Position = vec4(2.0 * texel / float(CAUSTIC_TEXELS + 2 * CAUSTIC_RIM) - 1.0, 0.0, 1.0);
}

// @part photon
// A photon's share in a texel: the uniform cubic B-spline around the place where it lands.
flat in vec3 v_photon;
flat in vec4 v_part;
out vec4 o_light;

float bspline(float x) {
    float a = abs(x);
    float b = max(2.0 - a, 0.0);
    return a < 1.0 ? (4.0 - 6.0 * a * a + 3.0 * a * a * a) / 6.0 : b * b * b / 6.0;
}

void main() {
    vec2 way = gl_FragCoord.xy - v_photon.xy;
    o_light = bspline(way.x) * bspline(way.y) * v_photon.z * v_part;
}

// @part smooth_rows
// The caustic map from a refracted grid drawn at half texels, as smooth as the one from photons: the cubic B-spline of a texel along
// the rows, for each colour as far beside as its light lands beside what was drawn.
uniform sampler2D u_caustic_light;
uniform vec3 u_caustic_across[CAUSTIC_TAPS]; // weights of red, green and blue, of columns of half texels
out vec4 o_light;

void main() {
    ivec2 first = ivec2(2 * as_int(floor(gl_FragCoord.x)) + CAUSTIC_RIM - CAUSTIC_BEFORE, as_int(floor(gl_FragCoord.y)));
    vec3 sum = vec3(0.0);
    for (int i = 0; i < CAUSTIC_TAPS; ++i) {
        vec3 light = texel_at(u_caustic_light, first + ivec2(i, 0)).rgb;
        sum += (CAUSTIC_WHITE ? light.rrr : light) * u_caustic_across[i];
    }
    o_light = vec4(sum, 0.0);
}

// @part smooth_columns
// The same along the columns.
uniform sampler2D u_caustic_rows;
uniform vec3 u_caustic_along[CAUSTIC_TAPS];
out vec4 o_light;

void main() {
    ivec2 first = ivec2(as_int(floor(gl_FragCoord.x)), 2 * as_int(floor(gl_FragCoord.y)) + CAUSTIC_RIM - CAUSTIC_BEFORE);
    vec3 sum = vec3(0.0);
    for (int j = 0; j < CAUSTIC_TAPS; ++j) {
        sum += texel_at(u_caustic_rows, first + ivec2(0, j)).rgb * u_caustic_along[j];
    }
    o_light = vec4(sum, 0.0);
}
