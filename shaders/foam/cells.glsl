// A look of foam with thickness and bubbles' cells, over another look.

// @part cell
// The mask in one cell of a lattice of triangles (Heitz and Neyret 2018, Mikkelsen 2022): turned and shifted by the cell's hash.
// Lengths in tiles of the mask; the eye's place on the lattice is reduced in float64, whole steps apart from the rest.
uniform vec4 u_mask_matrix;  // rows of the turn, over the tile's side (1/m)
uniform vec4 u_cell_matrix;  // metres to steps along the triangles' sides
uniform vec2 u_cell_offset;  // the eye's place, steps modulo 1
uniform vec2 u_cell_index;   // the eye's place, steps modulo 4096: its whole part counts

// The cell that is looked at: where the place is on its mask, and its turn. Set before the look reads the mask.
vec2 cell_uv;
vec2 cell_turn;

void cell_enter(ivec2 cell, vec2 steps) {
    uint word = noise_hash(noise_hash(uint(cell.x & 4095)) ^ uint(cell.y & 4095));
    float angle = TAU * noise_share(noise_hash(word)) - PI;
    cell_turn = vec2(cos(angle), sin(angle));
    vec2 way = vec2(steps.x + 0.5 * steps.y, 0.866025403784439 * steps.y);
    vec2 turned = vec2(cell_turn.x * way.x + cell_turn.y * way.y, cell_turn.x * way.y - cell_turn.y * way.x);
    cell_uv = turned + vec2(noise_share(noise_hash(word + 1u)), noise_share(noise_hash(word + 2u)));
}

vec2 mask_turn(vec2 p) {
    vec2 tiles = vec2(dot(u_mask_matrix.xy, p), dot(u_mask_matrix.zw, p));
    return vec2(cell_turn.x * tiles.x + cell_turn.y * tiles.y, cell_turn.x * tiles.y - cell_turn.y * tiles.x);
}

vec2 mask_uv(vec2 p) {
    return cell_uv;
}

// The three corners of the triangle that a place is in: whole steps from the eye's own, and the place's share of each.
void cell_corners(vec2 p, out ivec2 corner[3], out vec2 way[3], out vec3 share) {
    vec2 steps = vec2(dot(u_cell_matrix.xy, p), dot(u_cell_matrix.zw, p)) + u_cell_offset;
    vec2 base = floor(steps);
    vec2 t = steps - base;
    ivec2 eye = as_int(floor(u_cell_index - u_cell_offset + 0.5));
    bool upper = t.x + t.y > 1.0;
    ivec2 offset[3] = ivec2[3](upper ? ivec2(1, 1) : ivec2(0, 0), ivec2(1, 0), ivec2(0, 1));
    share = upper ? vec3(t.x + t.y - 1.0, 1.0 - t.y, 1.0 - t.x) : vec3(1.0 - t.x - t.y, t.x, t.y);
    for (int i = 0; i < 3; ++i) {
        corner[i] = as_int(base) + eye + offset[i];
        way[i] = t - vec2(offset[i]);
    }
}

// @part sharp
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

// @part blended
// A look in cells, each with its own turn of the mask. Where cells meet each thins its foam, and what neither covers stays free:
// foam/shading.glsl@cover. So no foam turns grey between cells, and the share that is covered is s everywhere.
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
