// Of the second tile as it is now.
vec3 short_bounds() {
    return texelFetch(u_sea_bounds_1, ivec2(0), 0).xyz;
}
