// The tree of land's maxima: LAND_CELLS cells along a side of the square, and half as many a level, level by level side by side.
// Of the level that a column of its texels is in: cells along a side, and where its own columns begin.
ivec2 land_level(int column) {
    int left = 0;
    int cells = LAND_CELLS;
    while (cells > 1 && column >= left + cells) {
        left += cells;
        cells >>= 1;
    }
    return ivec2(cells, left);
}
