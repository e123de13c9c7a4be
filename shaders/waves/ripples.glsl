// Ripples of the wind.

// @part bands
// What is left of a band of ripples under a footprint; x: k of the band (rad/m), y: its mean square slope.
uniform vec2 u_ripples_band[4];

float ripples_kept(int band, Footprint fp) {
    if (!SURFACE_FILTER) {
        return 1.0;
    }
    float k = u_ripples_band[band].x;
    return wave_kept(k * k, fp);
}

float ripples_lost(vec4 kept) {
    vec4 mss = vec4(u_ripples_band[0].y, u_ripples_band[1].y, u_ripples_band[2].y, u_ripples_band[3].y);
    return dot(mss, 1.0 - kept * kept);
}

// @part gusts
// Gusts run over the ripples: gradient noise that moves with the wind and changes as it goes. docs/formulae.md, section 9. The place is
// reduced in float64; the noise repeats after 256 cells.
uniform float u_gust_phase[3]; // the eye's place in the noise: x, z, time; rad, a turn is 256 cells
uniform float u_gust_size;     // m
uniform float u_gust_strength;

vec3 ripples_detail(vec2 p, Footprint fp) {
    vec3 place = vec3(u_gust_phase[0], u_gust_phase[1], u_gust_phase[2]) * 40.7436654315252 + vec3(p / u_gust_size, 0.0);
    float width = SURFACE_FILTER ? sqrt(max(dot(fp.x, fp.x), dot(fp.y, fp.y))) / u_gust_size : 0.0;
    float gust = 1.0 + u_gust_strength * clamp(0.8 * fractal_3(place, width, 3, uint(GUST_SEED)), -1.0, 1.0);
    vec3 even = even_detail(p, fp);
    return vec3(gust * even.xy, gust * gust * even.z);
}

// @part exact
// Ripples summed at the point itself: exact to float32.
uniform vec4 u_ripples_wave[2 * RIPPLE_COPIES * RIPPLE_WAVES]; // k.x, k.z (rad/m), slope, band
uniform float u_ripples_phase[2 * RIPPLE_COPIES * RIPPLE_WAVES];

// Gradient, and the unresolved mean square slope.
vec3 ripples_detail(vec2 p, Footprint fp) {
    vec4 kept = vec4(ripples_kept(0, fp), ripples_kept(1, fp), ripples_kept(2, fp), ripples_kept(3, fp));
    vec2 slope = vec2(0.0);
    for (int i = 0; i < 2 * RIPPLE_COPIES * RIPPLE_WAVES; ++i) {
        vec4 wave = u_ripples_wave[i];
        float amount = -kept[as_int(wave.w)] * wave.z * whole_sine_cosine(wrap_phase(u_ripples_phase[i] - dot(wave.xy, p))).y;
        slope += amount * normalize(wave.xy);
    }
    return vec3(slope, ripples_lost(kept));
}

// @part tile
// Ripples read from the two tiles that the frame drew: exact at the texels, bilinear between them. A tile alone shows as a lattice, so
// each is read once more, turned. docs/formulae.md, section 2.
uniform sampler2D u_ripples_0;
uniform sampler2D u_ripples_1;
uniform vec2 u_ripples_offset[2 * RIPPLE_COPIES]; // the eye's place in each tile and in its copy, in tiles
uniform float u_ripples_size[2];                  // m

const mat2 RIPPLES_TURN = mat2(20.0, 21.0, -21.0, 20.0) / 29.0;

vec2 ripples_copy(int i, vec2 p, vec4 kept) {
    vec4 long_tile = textureLod(u_ripples_0, p / u_ripples_size[0] + u_ripples_offset[i], 0.0);
    vec4 short_tile = textureLod(u_ripples_1, p / u_ripples_size[1] + u_ripples_offset[i + 1], 0.0);
    return kept.x * long_tile.xy + kept.y * long_tile.zw + kept.z * short_tile.xy + kept.w * short_tile.zw;
}

// Gradient, and the unresolved mean square slope.
vec3 ripples_detail(vec2 p, Footprint fp) {
    vec4 kept = vec4(ripples_kept(0, fp), ripples_kept(1, fp), ripples_kept(2, fp), ripples_kept(3, fp));
    vec2 slope = ripples_copy(0, p, kept);
    if (RIPPLE_COPIES > 1) {
        slope += RIPPLES_TURN * ripples_copy(2 * (RIPPLE_COPIES - 1), p * RIPPLES_TURN, kept);
    }
    return vec3(slope, ripples_lost(kept));
}

// @part tile_pass
// Slopes of one tile of ripples, drawn every frame: r, g hold the longer band, b, a the shorter. docs/formulae.md, section 2.
uniform vec2 u_viewport;
uniform vec4 u_ripples_wave[RIPPLE_WAVES]; // k.x, k.z (rad/m), slope, unused
uniform float u_ripples_phase[RIPPLE_WAVES];
uniform float u_ripples_tile;
out vec4 o_slopes;

void main() {
    vec2 p = gl_FragCoord.xy / u_viewport * u_ripples_tile;
    vec2 bands[2] = vec2[2](vec2(0.0), vec2(0.0));
    for (int i = 0; i < RIPPLE_WAVES; ++i) {
        vec3 wave = u_ripples_wave[i].xyz;
        vec2 slope = -wave.z * normalize(wave.xy) * whole_sine_cosine(wrap_phase(u_ripples_phase[i] - dot(wave.xy, p))).y;
        bands[i * 2 / RIPPLE_WAVES] += slope;
    }
    o_slopes = vec4(bands[0], bands[1]);
}
