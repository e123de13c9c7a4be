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
    ivec2 eye = ivec2(floor(u_cell_index - u_cell_offset + 0.5));
    bool upper = t.x + t.y > 1.0;
    ivec2 offset[3] = ivec2[3](upper ? ivec2(1, 1) : ivec2(0, 0), ivec2(1, 0), ivec2(0, 1));
    share = upper ? vec3(t.x + t.y - 1.0, 1.0 - t.y, 1.0 - t.x) : vec3(1.0 - t.x - t.y, t.x, t.y);
    for (int i = 0; i < 3; ++i) {
        corner[i] = ivec2(base) + eye + offset[i];
        way[i] = t - vec2(offset[i]);
    }
}
