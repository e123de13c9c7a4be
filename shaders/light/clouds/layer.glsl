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
