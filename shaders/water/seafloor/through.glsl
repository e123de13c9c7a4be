// The level floor along the ray refracted at the surface. Ripples that face away are taken edge-on; none may tilt it level.
void look_through(vec2 p, float height, vec3 d, vec3 normal, float lost, Footprint fp) {
    float c = max(-dot(normal, d), 0.0);
    vec3 down = refracted(d, normal, c, INDEX);
    // A trough may reach the floor.
    bed_down = max(u_floor_depth + height, 0.0);
    bed_way = bed_down / max(-down.y, 0.25);
    // What the footprint took out of the surface bends the ray by a third of its slope.
    float blur = 0.34 * sqrt(lost) * bed_way;
    Footprint seen = Footprint(fp.x + vec2(blur, 0.0), fp.y + vec2(0.0, blur));
    bed_seen = bed_light(p + bed_way * down.xz, bed_down, seen);
}
