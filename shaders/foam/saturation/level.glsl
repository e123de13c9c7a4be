// The footprint on level water, from place and height. The one on a wave's face that is turned to the eye is shorter, but the pixel
// sees on over its crest to the next waves. docs/formulae.md, section 4.
Footprint level_footprint(vec2 p, float height) {
    vec3 way = vec3(p.x, height - u_eye_height, p.y);
    float tau = max(dot(way, u_ray_z) / dot(u_ray_z, u_ray_z), 1e-6);
    return footprint(way / tau, tau, vec3(0.0, way.y > 0.0 ? -1.0 : 1.0, 0.0));
}
