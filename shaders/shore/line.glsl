// Foam that the swash leaves on the sand: foam/saturation/surf_swept.glsl. It lies still.
float land_foam(vec2 p, float ground, Footprint fp) {
    vec2 q = shore_place(p);
    Footprint point = Footprint(vec2(0.0), vec2(0.0));
    float left = surf_swept(shore_field(q), ground, surf_patches(q, point), fp);
    surf_carried = vec3(0.0);
    return left > 0.0 ? min(foam_amount(left, p, fp), 1.0) : 0.0;
}
