// A look in cells, each with its own turn of the mask. Where cells meet each thins its foam, and what neither covers stays free:
// foam/cover.glsl. So no foam turns grey between cells, and the share that is covered is s everywhere.
float foam_amount(float f, vec2 p, Footprint fp) {
    ivec2 corner[3];
    vec2 way[3];
    vec3 share;
    cell_corners(p, corner, way, share);
    // The greatest share is a third or more, so the weights never vanish together.
    vec3 weight = max(share - 0.25, 0.0);
    weight *= weight;
    weight *= weight;
    weight /= weight.x + weight.y + weight.z;
    vec2 left = cover_free(clamp(f, 0.0, 1.0));
    float free = 1.0;
    // As many rounds as cells count here, asked at the end: drivers without branches would go through all three.
    do {
        bool first = weight.x > 0.0;
        bool second = !first && weight.y > 0.0;
        float part = first ? weight.x : second ? weight.y : weight.z;
        cell_enter(first ? corner[0] : second ? corner[1] : corner[2], first ? way[0] : second ? way[1] : way[2]);
        free *= 1.0 - cell_amount(cover_part(left, part), p, fp);
        weight = first ? vec3(0.0, weight.yz) : second ? vec3(0.0, 0.0, weight.z) : vec3(0.0);
    } while (weight.x + weight.y + weight.z > 0.0);
    return 1.0 - free;
}
