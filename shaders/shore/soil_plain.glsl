// Land without detail: smooth, its colours by height and slope.
const float FILM_ROUGHNESS = 0.02; // mean square slope of the film of water on wet ground

Soil land_soil(vec2 q, vec4 ground, Footprint fp, vec2 wet) {
    return Soil(normalize(vec3(-ground.y, 1.0, -ground.z)), ground_albedo(ground, shore_grain(q, fp)), wet.y);
}
