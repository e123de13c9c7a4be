// Bounds of the two raised tiles as they are now.
uniform sampler2D u_sea_bounds_0;
uniform sampler2D u_sea_bounds_1;

vec3 sea_bounds(vec3 ray, float aside, float from) {
    return texel_at(u_sea_bounds_0, ivec2(0)).xyz + texel_at(u_sea_bounds_1, ivec2(0)).xyz;
}
