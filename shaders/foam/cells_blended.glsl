// A look in cells, each with its own turn of the mask. Where cells meet each thins its foam, and what neither covers stays free:
// masks that know nothing of each other leave (1 - s1)(1 - s2) free, which is 1 - s for 1 - si = (1 - s)^wi, w1 + w2 + w3 = 1.
// So no foam turns grey between cells, and the share that is covered is s everywhere.
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
    float left = 1.0 - clamp(f, 0.0, 1.0);
    // A power below 1 has an endless slope at 0: held there, and led to 0 evenly, so that all is covered where s is 1.
    float held = max(left, 1.0 / 256.0);
    float last = smoothstep(0.0, 1.0 / 256.0, left);
    float free = 1.0;
    for (int i = 0; i < 3; ++i) {
        if (weight[i] > 0.0) {
            cell_enter(corner[i], way[i]);
            free *= 1.0 - cell_amount(1.0 - pow(held, weight[i]) * last, p, fp);
        }
    }
    return 1.0 - free;
}
