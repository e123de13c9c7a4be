// The sun's direction in the picture: along a direction of it, across, and toward the eye. A unit vector.
vec3 spray_sunward(vec2 along) {
    vec3 right = u_ray_x / length(u_ray_x);
    vec3 up = u_ray_y / length(u_ray_y);
    vec2 sun = vec2(dot(u_sun_direction, right), dot(u_sun_direction, up));
    return vec3(dot(sun, along), dot(sun, vec2(-along.y, along.x)), -dot(u_sun_direction, u_ray_z));
}
