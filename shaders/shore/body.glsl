// Water over the shore's floor: what comes back from it is absorbed and scattered out along the true way down and up.
float shore_path = 0.0;          // m; set before the water is shaded
vec3 shore_albedo = vec3(0.0);

vec3 water_body(vec3 below, vec3 deep, vec3 extinction, float cv, float height) {
    return mix(deep, shore_albedo * below, exp(-extinction * shore_path));
}
