// Dry land: where rays meet it, its light, and what grows on it.

// @part land_maxima
// Heights of the land, by cells of a square: levels of half as many cells side by side. r: what it reaches at most in a cell; g: in that
// and the eight round it; b, a, of the finest level: the heights from which the sun's upper and lower rim are seen over it; m.
uniform sampler2D u_land_maxima;

// @part find_land
// First hit of the ray with land, above y = 0 and inside the square, before `farthest`.
bool find_land(vec3 ray, float farthest, out float tau, out vec4 ground) {
    vec2 eye = shore_place(vec2(0.0));
    vec2 span = land_span(eye, u_eye_height, ray);
    float enter = max(span.x, march_start(ray).g);
    float leave = min(span.y, farthest);
    if (enter < leave) {
        enter = land_free(eye, u_eye_height, ray, 0.0, 0.0, enter, leave);
    }
    tau = enter;
    ground = vec4(0.0);
    if (enter >= leave) {
        return false;
    }
    float fine = march_tolerance();
    float before;
    float gap;
    march_ground(eye, u_eye_height, ray, leave, fine, 0.0, true, tau, before, gap, ground);
    bool passed = tau < leave && gap < -fine * tau;
    // Counted, so that drivers without branches do not go through all of them in vain.
    int rounds = passed ? 8 : 0;
    for (int i = 0; i < rounds; ++i) {
        float middle = 0.5 * (before + tau);
        if (u_eye_height + middle * ray.y < shore_floor(eye + middle * ray.xz).x) {
            tau = middle;
        } else {
            before = middle;
        }
    }
    if (passed) {
        ground = shore_floor(eye + tau * ray.xz);
        gap = u_eye_height + tau * ray.y - ground.x;
    }
    if (tau >= leave || gap >= fine * tau) {
        return false;
    }
    refine_ground(eye, u_eye_height, ray, 1.0, fine, enter, REFINE, false, tau, gap, ground);
    return true;
}

// @part tree
// The tree of land's maxima: LAND_CELLS cells along a side of the square, and half as many a level, level by level side by side.
// Of the level that a column of its texels is in: cells along a side, and where its own columns begin.
ivec2 land_level(int column) {
    int left = 0;
    int cells = LAND_CELLS;
    while (cells > 1 && column >= left + cells) {
        left += cells;
        cells >>= 1;
    }
    return ivec2(cells, left);
}

// @part land_flat
// No light: land is black, as water is.
vec3 land_light(vec3 d, vec3 level, Soil soil, float sun) {
    return vec3(0.0);
}

// @part land_lit
// Land under sun and sky; where it is wet, the sky mirrors in its film of water. d, level: unit vectors, level: normal of the film;
// sun: the share of the sun that reaches it.
vec3 land_light(vec3 d, vec3 level, Soil soil, float sun) {
    float nv = max(-dot(level, d), 0.0);
    float mirror = soil.film * fresnel(sqrt(nv * nv + FILM_ROUGHNESS * (1.0 - nv * nv)));
    vec3 r = reflect(d, level);
    r.y = sqrt(max(r.y, 0.0) * max(r.y, 0.0) + FILM_ROUGHNESS);
    return (1.0 - mirror) * soil.albedo / PI * irradiance_past(soil.normal, sun) + mirror * sky_light(normalize(r));
}

// @part land_film
// Land under sun and sky; where it is wet, sky and sun mirror in its film of water. d, level: unit vectors, level: normal of the film;
// sun: the share of the sun that reaches it.
vec3 land_light(vec3 d, vec3 level, Soil soil, float sun) {
    float nv = max(-dot(level, d), 0.0);
    float cv = sqrt(nv * nv + FILM_ROUGHNESS * (1.0 - nv * nv));
    float mirror = soil.film * fresnel(cv);
    vec3 r = reflect(d, level);
    r.y = sqrt(max(r.y, 0.0) * max(r.y, 0.0) + FILM_ROUGHNESS);
    vec3 light = (1.0 - mirror) * soil.albedo / PI * irradiance_past(soil.normal, sun);
    if (mirror <= 0.0) {
        return light;
    }
    // Facets as those of the water (light/glitter/beckmann.glsl).
    vec3 between = u_sun_direction - d;
    vec3 h = between / max(length(between), 1e-6);
    float nh = max(dot(level, h), 1e-3);
    float nh2 = nh * nh;
    float slopes = exp(-max(1.0 - nh2, 0.0) / (nh2 * FILM_ROUGHNESS)) / (PI * FILM_ROUGHNESS * nh2 * nh2);
    vec3 glint = min(u_sun_irradiance * (fresnel(max(dot(u_sun_direction, h), 0.0)) * slopes / (4.0 * cv)), 1e4);
    return light + mirror * sky_light(normalize(r)) + soil.film * sun * glint;
}

// @part land_pass
// Land where the samples' rays meet it. Linear light; no foam.
uniform sampler2D u_met; // tau, and what is there: 2 is land
out vec4 o_color;

void main() {
    vec2 met = texel_at(u_met, as_int(floor(sample_place()))).rg;
    if (met.g != 2.0) {
        discard;
    }
    vec3 ray = camera_ray(sample_place());
    o_color = land_color(ray, normalize(ray), met.r, shore_floor(shore_place(met.r * ray.xz)));
}

// @part land_samples_pass
// What the samples of land are, kept for the pass that lights them.
uniform sampler2D u_met; // tau, and what is there: 2 is land
layout(location = 0) out vec4 o_albedo; // and film
layout(location = 1) out vec4 o_normal; // and amount of foam
layout(location = 2) out vec4 o_nothing; // WebGL wants as many as there are layers

void main() {
    vec2 met = texel_at(u_met, as_int(floor(sample_place()))).rg;
    if (met.g != 2.0) {
        discard;
    }
    vec3 ray = camera_ray(sample_place());
    vec2 p = met.r * ray.xz;
    vec4 ground = shore_floor(shore_place(p));
    float amount;
    Soil soil = land_sample(p, ground, footprint(ray, met.r, normalize(vec3(-ground.y, 1.0, -ground.z))), amount);
    o_albedo = vec4(soil.albedo, soil.film);
    o_normal = vec4(soil.normal, amount);
    o_nothing = vec4(0.0);
}

// @part land_shown_pass
// Where land shows: its depth alone, so that neither the water nor the sky is shaded there, nor land elsewhere. As many outputs as samples
// have layers.
uniform sampler2D u_met; // tau, and what is there: 2 is land
layout(location = 0) out vec4 o_color;
layout(location = 1) out vec4 o_second;
layout(location = 2) out vec4 o_third;

void main() {
    if (texel_at(u_met, as_int(floor(sample_place()))).g != 2.0) {
        discard;
    }
    o_color = o_second = o_third = vec4(0.0);
}
