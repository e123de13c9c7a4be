// Water over a level floor that is lit by itself: its light comes up along the refracted ray.
vec3 bed_seen = vec3(0.0); // radiance of the floor; set before the water is shaded
float bed_way = 0.0;       // from the floor up to the eye's ray, m
float bed_down = 0.0;      // straight down to it, m

vec3 water_body(vec3 below, vec3 deep, vec3 extinction, float cv, float height) {
    return deep * (1.0 - exp(-extinction * (bed_way + bed_down))) + bed_seen * exp(-extinction * bed_way);
}
