// Clouds: the layer, cirrus, rain, and the shadow on the water.

// @part way
// The way to a layer that is high (m) over the eye of a round earth, and the sine of the look's slant there.
const float EARTH = 6.371e6;   // radius, m
const float CLOUD_WIDTH = 1.4; // of a cell's fading, over the deviation of looks that fades it

vec2 way_to_layer(vec3 d, float high) {
    float along = EARTH * d.y;
    // Without the difference of two great numbers.
    float rest = (2.0 * EARTH + high) * high;
    float way = rest / (along + sqrt(along * along + rest));
    return vec2(way, (along + way) / (EARTH + high));
}

// @part layer
// A layer of clouds over a round earth: gradient noise that drifts and changes, lit from the lamp's side. docs/formulae.md, section 9.
// Its place is reduced in float64; the noise repeats after 256 cells.
uniform float u_cloud_phase[3];  // the eye's place in the noise: x, z, time; rad, a turn is 256 cells
uniform vec4 u_cloud_shape;      // height (m), size (m), density 0 at this much noise, optical depth
uniform float u_cloud_softness;
uniform vec4 u_cloud_far;        // light of the air that they keep the lamp from, premultiplied by its share
uniform float u_cloud_tall;      // from foot to top, m
uniform vec4 u_cloud_edge;       // noise over a slice's start in the middle of its edge, its deviation there; opacity that a mean of all
                                 // misses, and that parted slices have more
uniform vec3 u_cloud_mean;       // what clouds have in the mean of the lamp, of the light that haze scatters, and of the sky
uniform vec3 u_cloud_parted;     // and those whose slices are parted
uniform vec3 u_cloud_toward;     // toward what lights it
uniform vec3 u_cloud_light;      // irradiance up there
uniform vec3 u_cloud_sky;        // radiance of the light that comes from all sides

const float CLOUD_TAPER = 0.9;   // rise of the edge's noise from the cloud's foot to its top
const float CLOUD_STEP = 0.2;    // cells toward the lamp
const float CLOUD_DARK = 0.3;
const float CLOUD_CORE = -1.2;
const float CLOUD_RELIEF = 0.3;
const int CLOUD_AHEAD = 2;

// Octaves of gradient noise, as wide as a sample (cells); x: all, y: those after the first, z: those that are not read toward the lamp.
// lost: the variance that they do not have, of 1.
vec3 cloud_octaves(vec3 x, float width, int end, out float lost) {
    vec3 sum = vec3(0.0);
    float strength = 4.2631;
    float variance = 0.6636;
    lost = 1.0;
    for (int i = 0; i < end; ++i) {
        float kept = 1.0 - smoothstep(0.15, 0.6, width);
        if (kept <= 0.0) {
            break;
        }
        sum += strength * kept * noise_3(x, uint(CLOUD_SEED + i)) * vec3(1.0, i >= 1 ? 1.0 : 0.0, i >= CLOUD_AHEAD ? 1.0 : 0.0);
        lost -= variance * kept * kept;
        x = vec3(2.0 * x.x + x.y + 0.37, 2.0 * x.y - x.x + 0.71, 2.0 * x.z + 0.53);
        width *= 2.23606797749979;
        strength *= 0.58;
        variance *= 0.3364;
    }
    return sum;
}

// Clouds drown in the air along the horizon, which has their mean light; from above there are none.
float clouds_stand_over() {
    return 1.0 - smoothstep(0.5, 0.9, u_eye_height / u_cloud_shape.x);
}

// What clouds() is for a level look.
vec4 clouds_along_horizon() {
    return clouds_stand_over() * u_cloud_far;
}

// Premultiplied light of the clouds toward d, and how much they cover of the sky there, seen with a spread of looks (deviation up and
// down, and aside; rad); hidden: how much of what is behind all air.
vec4 clouds(vec3 d, vec2 spread, out float hidden) {
    hidden = 0.0;
    float under = clouds_stand_over();
    float seen = under * smoothstep(0.01, 0.08, d.y);
    if (seen <= 0.0) {
        return under * u_cloud_far;
    }
    vec2 reached = way_to_layer(d, u_cloud_shape.x - u_eye_height);
    float way = reached.x;
    float slant = reached.y;
    float cell = 1.0 / u_cloud_shape.y;
    vec3 eye = vec3(u_cloud_phase[0], u_cloud_phase[1], u_cloud_phase[2]) * 40.7436654315252;
    vec3 place = eye + vec3(d.xz * way * cell, 0.0);
    float width = CLOUD_WIDTH * way * cell * max(spread.x / slant, spread.y);

    // Three slices of the cloud, which stands on the layer: farther ones are higher. Its height is the noise's third dimension.
    float tall = u_cloud_tall * cell;
    vec3 climb = vec3(d.xz * min(tall / slant, 0.9), tall);
    vec4 noise = vec4(0.0);
    float lost = 1.0;
    // The last place is toward the lamp: what lies there stands in its light. What is finer than the first octave is the same all the way
    // through, and what is finest toward the lamp too. One loop, so that the noise stands in the program once.
    for (int i = 0; i < 4; ++i) {
        vec3 at = place + (i == 3 ? 0.4 * climb + CLOUD_STEP * u_cloud_toward.xzy : 0.4 * float(i) * climb);
        float rest;
        vec3 octaves = cloud_octaves(at, width, i == 1 ? CLOUD_OCTAVES : i == 3 ? CLOUD_AHEAD : 1, rest);
        noise += octaves.x * vec4(equal(ivec4(i), ivec4(0, 1, 2, 3)));
        if (i == 1) {
            noise += vec4(octaves.y, 0.0, octaves.yz);
            lost = rest;
        }
    }

    // A mean over the lost noise: the edges, as much wider.
    vec3 start = u_cloud_shape.z + CLOUD_TAPER * vec3(0.0, 0.4, 0.8);
    lost = max(lost, 0.0);
    float narrow = u_cloud_edge.y * inversesqrt(u_cloud_edge.y * u_cloud_edge.y + lost);
    vec4 edges = u_cloud_edge.x + start.xyzy;
    noise = edges + (noise - edges) * narrow;
    vec3 density = smoothstep(vec3(0.0), vec3(1.0), (noise.xyz - start) / u_cloud_softness);
    vec3 shade = smoothstep(vec3(0.0), vec3(1.0), (noise.w - start - 0.2 * CLOUD_TAPER) / u_cloud_softness);
    vec3 core = max(noise.xyz - max(start + 0.5 * u_cloud_softness, CLOUD_CORE), 0.0);
    float thick = u_cloud_shape.w;
    vec3 deep = thick / 3.0 * density;
    vec3 above = thick * (vec3(0.5, 0.33, 0.17) * density + 0.15 * core * core);
    above.x += deep.y + deep.z; above.y += deep.z;

    float relief = clamp(1.0 + CLOUD_RELIEF * (noise.y - noise.w), 0.35, 1.25);
    vec3 direct = exp(-0.5 * thick * shade) * relief;
    vec3 diffuse = relief / (1.0 + CLOUD_DARK * above);
    // A deck has as much less of a low lamp as it faces it less.
    float faced = sqrt(max(u_cloud_toward.y, 0.0) + 0.03);
    vec3 lit = 0.3 * (0.55 * direct + 0.45 * faced * diffuse);
    vec3 sky = mix(vec3(0.6, 0.8, 1.0), vec3(1.0), direct) * (0.35 + 0.65 * diffuse);
    vec3 stays = exp(-deep);
    vec3 met = (1.0 - stays) * vec3(1.0, stays.x, stays.x * stays.y);
    float left = stays.x * stays.y * stays.z;
    vec3 shines = vec3(dot(met, lit), 0.0, dot(met, sky)) / max(1.0 - left, 1e-6);
    shines.y = 0.3 * left;
    // Blurred clouds shine as their mean does.
    float parted = smoothstep(0.0, 1.7, length(climb));
    float kept = 1.0 - smoothstep(0.15, 0.6, width);
    shines = mix(shines, mix(u_cloud_mean, u_cloud_parted, parted), sqrt(lost));
    float more = u_cloud_edge.z * lost * sqrt(lost) + u_cloud_edge.w * parted * (1.0 - kept * kept);
    hidden = seen * clamp(1.0 - left + more, 0.0, 1.0);
    // The air before clouds is lit where the lamp passes between them.
    float cover = hidden * exp(-0.8 * (1.0 - u_cloud_far.a) * min(max(air_depth(d.y).x, 0.0), 60.0));
    return vec4((u_cloud_light * (shines.x + shines.y * mie_phase(dot(d, u_cloud_toward))) + u_cloud_sky * shines.z) * cover, cover) + (under - seen) * u_cloud_far;
}

// @part cirrus
// High clouds of ice: streaks of gradient noise, where broad patches of it let them be. docs/formulae.md, section 9.
uniform float u_cirrus_phase[4]; // the eye's place: along the streaks and across in the streaks' noise, then in the patches'; rad
uniform vec4 u_cirrus_shape;     // height (m), size (m), noise where they begin, optical depth
uniform vec2 u_cirrus_along;     // heading of the streaks
uniform vec3 u_cirrus_light;     // irradiance up there
uniform vec3 u_cirrus_sky;       // radiance of the light that comes from all sides

const float CIRRUS_STRETCH = 8.0;

// Premultiplied light of the streaks toward d, and how much they cover of the sky there; hidden: how much of what is behind all air.
vec4 cirrus(vec3 d, vec2 spread, out float hidden) {
    hidden = 0.0;
    float seen = smoothstep(0.01, 0.1, d.y) * (1.0 - smoothstep(0.5, 0.9, u_eye_height / u_cirrus_shape.x));
    if (seen <= 0.0) {
        return vec4(0.0);
    }
    vec2 way = way_to_layer(d, u_cirrus_shape.x - u_eye_height);
    float cell = 1.0 / u_cirrus_shape.y;
    vec2 at = way.x * cell * vec2(dot(d.xz, u_cirrus_along), d.z * u_cirrus_along.x - d.x * u_cirrus_along.y);
    float width = CLOUD_WIDTH * way.x * cell * max(spread.x / way.y, spread.y);
    vec2 streak = vec2(u_cirrus_phase[0], u_cirrus_phase[1]) * 40.7436654315252 + at * vec2(1.0 / CIRRUS_STRETCH, 1.0);
    vec2 spot = vec2(u_cirrus_phase[2], u_cirrus_phase[3]) * 40.7436654315252 + at * vec2(0.125, 0.25);
    float broad = fractal_2(spot, 0.25 * width, 2, uint(CIRRUS_SEED));
    // Winds that shear bend the streaks.
    streak.y += 0.35 * broad;
    float fine = fractal_2(3.0 * streak, 3.0 * width, 5, uint(CIRRUS_SEED + 8));
    float density = smoothstep(0.0, 2.4, broad - u_cirrus_shape.z) * smoothstep(-1.2, 2.4, fine + 0.5 * broad);
    hidden = seen * (1.0 - exp(-u_cirrus_shape.w * density));
    float cover = hidden * exp(-0.8 * min(max(air_depth(d.y).x, 0.0), 60.0));
    float lit = 0.2 + 0.3 * mie_phase(dot(d, u_sun_direction));
    return vec4((u_cirrus_light * lit + u_cirrus_sky) * cover, cover);
}

// @part rain
// Rain under the thickest clouds: veils that stand around at three distances, and slant. docs/formulae.md, section 9.
uniform float u_cloud_rain; // optical depth

const float RAIN_LIGHT = 0.55;           // of the mean of clouds
const vec3 RAIN_SLANT = vec3(0.2, 0.1, -0.25); // cells, from the clouds' foot to the water: what is lower left the clouds earlier
const float RAIN_SPREADS = 0.06;         // cells, over the same fall
const float RAIN_FADES = 30000.0;        // m

// Light from behind the rain toward d, and its own; a: of what is behind all clouds; hidden: how much of what is behind all air.
vec4 in_rain(vec4 light, vec3 d, vec2 spread, inout float hidden) {
    float level = length(d.xz);
    float high = u_cloud_shape.x - u_eye_height;
    if (d.y <= 0.0 || high <= 0.0) {
        return light;
    }
    float cell = 1.0 / u_cloud_shape.y;
    vec3 eye = vec3(u_cloud_phase[0], u_cloud_phase[1], u_cloud_phase[2]) * 40.7436654315252;
    float depth = 0.0;
    for (int i = 0; i < 3; ++i) {
        float far = (2.0 + float(i) * (2.0 + float(i))) * u_cloud_shape.y;
        // Height of the look there, of the clouds' foot.
        float up = far * d.y / (max(level, 1e-3) * high);
        if (up >= 1.0) {
            continue;
        }
        vec3 at = eye + vec3(d.xz / max(level, 1e-3) * far * cell, 0.0) + RAIN_SLANT * (1.0 - up);
        float width = CLOUD_WIDTH * spread.y * far * cell + RAIN_SPREADS * (1.0 - up);
        float rest;
        float noise = cloud_octaves(at, width, 3, rest).x;
        float falls = smoothstep(0.0, 2.0, noise - max(u_cloud_shape.z, -0.6));
        depth += falls * (1.0 - smoothstep(0.2, 1.0, up)) * exp(-far / RAIN_FADES);
    }
    float left = exp(-u_cloud_rain * depth);
    hidden = 1.0 - (1.0 - hidden) * left;
    return mix(vec4(RAIN_LIGHT * u_cloud_far.rgb / max(u_cloud_far.a, 1e-3), 0.0), light, left);
}

// @part shadow
// The lamp's light past the clouds at a place, over its mean there: a column of the clouds where the way to the lamp meets them.
// docs/formulae.md, section 9. place: m from under the eye, y over still water.
uniform vec4 u_cloud_sunward; // way from still water to the clouds, along x and z, and up in them; deviation of the penumbra; cells
uniform vec3 u_cloud_gap;     // noise in the middle of the clouds' edge, its variance there, transmittance of the thickest
uniform vec2 u_cloud_shade;   // strength; mean transmittance

float cloud_sunlit(vec3 place, Footprint fp) {
    float cell = 1.0 / u_cloud_shape.y;
    float left = max(1.0 - place.y / u_cloud_shape.x, 0.0);
    vec3 eye = vec3(u_cloud_phase[0], u_cloud_phase[1], u_cloud_phase[2]) * 40.7436654315252;
    vec3 at = eye + vec3(place.xz * cell, 0.0) + vec3(left, left, 1.0) * u_cloud_sunward.xyz;
    // The footprint is a box, of a twelfth of its side's square in variance.
    float side2 = max(dot(fp.x, fp.x), dot(fp.y, fp.y)) * cell * cell / 12.0;
    float width = CLOUD_WIDTH * sqrt(side2 + u_cloud_sunward.w * u_cloud_sunward.w);
    float lost;
    float noise = cloud_octaves(at, width, CLOUD_SHADOW_OCTAVES, lost).x;
    // A mean over the lost noise, which is normal, as the edge is: as much wider.
    float x = clamp((u_cloud_gap.x - noise) * inversesqrt(u_cloud_gap.y + max(lost, 0.0)), -6.0, 6.0);
    float open = 1.0 / (1.0 + exp(-1.5976 * x - 0.07056 * x * x * x));
    float passed = mix(u_cloud_gap.z, 1.0, open);
    float under = 1.0 - smoothstep(0.5, 0.9, u_eye_height / u_cloud_shape.x);
    return mix(1.0, passed / u_cloud_shade.y, under * u_cloud_shade.x);
}
