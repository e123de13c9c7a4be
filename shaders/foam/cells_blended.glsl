// A look in cells, each with its own turn of the mask; the amounts of neighbours blend, and their mean stays what it was.
float foam_amount(float f, vec2 p, Footprint fp) {
    ivec2 corner[3];
    vec2 way[3];
    vec3 share;
    cell_corners(p, corner, way, share);
    // The greatest share is a third or more, so the weights never vanish together.
    vec3 weight = max(share - 0.25, 0.0);
    weight *= weight;
    weight *= weight;
    float sum = 0.0;
    for (int i = 0; i < 3; ++i) {
        if (weight[i] > 0.0) {
            cell_enter(corner[i], way[i]);
            sum += weight[i] * cell_amount(f, p, fp);
        }
    }
    return sum / (weight.x + weight.y + weight.z);
}
