// The two kinds of chosen pixels, of 4 and of 16 samples: how each fills a target twice as wide and high as the picture.
// x: samples along a pixel's side, 2 or 4. y: rows of the target a row of blocks. z: 1, rows from below, or -1, from above.
uniform vec3 u_chosen;

float chosen_total(vec2 both) {
    return u_chosen.x < 3.0 ? both.x : both.y;
}

// Blocks in a row.
int chosen_columns(int width) {
    return u_chosen.x < 3.0 ? width : width >> 1;
}
