// Foam's colour: albedo, light that is scattered back, relief, and what lies over the water.

// @part albedo
// Share of light that foam scatters back.
uniform float u_foam_albedo;

float foam_albedo() {
    return u_foam_albedo;
}

// @part added
// Foam is added to water and the sum clamped to a valid colour, as the paper's code does.
vec3 foam_over(vec3 water, vec3 foam, float amount) {
    return clamp(water + amount * foam, 0.0, 1.0);
}

// @part over
// Foam covers water.
vec3 foam_over(vec3 water, vec3 foam, float amount) {
    return mix(water, foam, amount);
}

// @part cover
// Foam that several masks share. What none of them covers stays free, and masks that know nothing of each other leave the product of
// what each leaves free: (1 - s1)(1 - s2) = 1 - s for 1 - si = (1 - s)^wi, w1 + w2 = 1. docs/formulae.md, section 5.

// What a cover s in [0, 1] leaves free: x * y. A power below 1 has an endless slope at 0: x, under the power, is held there, and y leads
// it to 0 evenly, so that all is covered where s is 1.
vec2 cover_free(float s) {
    float left = 1.0 - s;
    return vec2(max(left, 1.0 / 256.0), smoothstep(0.0, 1.0 / 256.0, left));
}

// The cover of a mask of weight w.
float cover_part(vec2 free, float w) {
    return 1.0 - pow(free.x, w) * free.y;
}

// @part scattering
// Foam as a lumpy layer of bubbles: two-stream opacity, a matt share, and a share that is scattered once, mostly forward.
// docs/formulae.md, section 6. n, d: unit vectors; f: saturation.
uniform float u_foam_depth;   // optical depth where the saturation is 1
uniform float u_foam_lumps;   // 2/pi of the mean square slope of its lumps
uniform float u_foam_forward; // share of the sun's light that is scattered once

// Mean cosine, or 0 where it is negative, over the lumps of a surface of mean cosine c.
float lumpy_cosine(float c) {
    return max(0.5 * (c + sqrt(c * c + u_foam_lumps)), 1e-3);
}

vec4 foam_layer(vec3 n, vec3 d, float f) {
    float eye = lumpy_cosine(-dot(n, d));
    float sun = lumpy_cosine(dot(n, u_sun_direction));
    float depth = u_foam_depth * clamp(f, 0.0, 1.0);
    float opacity = depth / (depth + 2.0 * eye);
    // 1 + G^2 - 2 G gamma is at least (1 - G)^2, so the power stays finite
    float apart = max(1.0 + FOAM_ASYMMETRY * FOAM_ASYMMETRY - 2.0 * FOAM_ASYMMETRY * dot(d, u_sun_direction),
        (1.0 - FOAM_ASYMMETRY) * (1.0 - FOAM_ASYMMETRY));
    float once = FOAM_PHASE / (apart * sqrt(apart) * (sun + eye));
    vec3 lit = u_sun_irradiance * (sun_past_foam.y * sun * mix(1.0 / PI, once, u_foam_forward))
        + u_sky_irradiance * ((0.5 + 0.5 * n.y) / PI);
    return vec4(foam_albedo() * opacity * lit, opacity);
}

// @part relief
// Foam has a thickness: toward the sun, as far away as its shade is long, is there foam too? It would take the sun from the water here,
// and an edge that looks at the sun is brighter for having none. docs/formulae.md, section 6.
uniform float u_foam_thickness; // m

void foam_relief(float f, float amount, vec2 p, Footprint fp) {
    if (f <= 0.0) {
        return;
    }
    // A low sun's shade ends after four thicknesses.
    vec2 way = u_foam_thickness / max(u_sun_direction.y, 0.25) * u_sun_direction.xz;
    float x = length(fp.x);
    float y = length(fp.y);
    // Far away edges and shades are too fine to be told apart.
    float near = 1.0 - smoothstep(0.25, 1.0, max(x, y) / max(length(way), 1e-6));
    if (near <= 0.0) {
        return;
    }
    // Soft: over half a thickness.
    Footprint soft = Footprint(max(1.0, 0.5 * u_foam_thickness / max(x, 1e-6)) * fp.x, max(1.0, 0.5 * u_foam_thickness / max(y, 1e-6)) * fp.y);
    // Foam so thin lets through and scatters on what it does not send back.
    near *= FOAM_SHADE;
    float beside = near * min(beside_amount(f, p, way, soft), 1.0);
    sun_past_foam = vec2(1.0 - beside, 1.0 + near * min(amount, 1.0) - beside);
}

// @part beside
// The foam amount some way beside a place, of the same saturation.
float beside_amount(float f, vec2 p, vec2 way, Footprint fp) {
    return foam_amount(f, p + way, fp);
}

// @part beside_filtered
// The foam amount some way beside a place, of the same saturation; of the mask alone, since its shade is soft.
float beside_amount(float f, vec2 p, vec2 way, Footprint fp) {
    foam_octaves = 1;
    return foam_amount(f, p + way, fp);
}

// @part beside_lying
// The foam amount some way beside a place, of the same saturation and on the same water; of the mask alone, since its shade is soft.
float beside_amount(float f, vec2 p, vec2 way, Footprint fp) {
    foam_octaves = 1;
    return lying_amount(foam_share_lying(f, p, fp), clamp(f, 0.0, 1.0), p + carry(p) + way, fp);
}
