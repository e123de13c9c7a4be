// The same from under the water: of its underside, whose normal is up too, or of the floor.
out vec4 o_geometry;

const float NO_FLOOR = 1e5;

void main() {
    vec3 ray = camera_ray(sample_place());
    vec3 d = normalize(ray);
    float tau;
    vec3 wave;
    bool underside = find_underside(ray, tau, wave);
    float reach = bed_reach(vec2(0.0), u_eye_height, d);
    o_geometry = reach < NO_FLOOR ? vec4(floor_normal(reach * d.xz), reach) : vec4(0.0);
    if (underside && tau * length(ray) <= reach) {
        vec2 p = tau * ray.xz;
        Footprint fp = footprint(ray, tau, vec3(wave.y, -1.0, wave.z));
        vec2 slope = waves_shading(p, fp).yz + detail(p, fp).xy;
        o_geometry = vec4(normalize(vec3(-slope.x, 1.0, -slope.y)), tau * length(ray));
    }
}
