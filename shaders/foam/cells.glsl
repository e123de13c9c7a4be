// A look in cells, each with its own turn of the mask: the nearest cell's alone, so that no threshold is softened.
float foam_amount(float f, vec2 p, Footprint fp) {
    ivec2 corner[3];
    vec2 way[3];
    vec3 share;
    cell_corners(p, corner, way, share);
    int near = share.x >= share.y && share.x >= share.z ? 0 : share.y >= share.z ? 1 : 2;
    cell_enter(corner[near], way[near]);
    return cell_amount(f, p, fp);
}
