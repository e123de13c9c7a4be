// Of the second tile as it is now.
vec3 short_bounds() {
    return texel_at(u_sea_bounds_1, ivec2(0)).xyz;
}
