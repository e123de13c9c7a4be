"""What a grid costs a driver: corners that its cache of corners does not have."""

import numpy as np
import pytest

from seafoam.render.gl.executor import grid

SLOTS = 256
"""Of the cache that llvmpipe keeps by a corner's number."""


@pytest.mark.parametrize(("rows", "columns"), [(7, 5), (64, 33), (144, 144), (288, 288)])
def test_a_row_of_cells_reads_the_corners_of_the_row_before_from_the_cache(rows: int, columns: int) -> None:
    vertices, indices = grid(rows, columns)
    assert len(vertices) == (rows + 1) * (columns + 1)
    kept, missed = np.full(SLOTS, -1), 0
    for index in indices.tolist():
        missed += kept[index % SLOTS] != index
        kept[index % SLOTS] = index
    assert missed <= 1.05 * len(vertices)


@pytest.mark.parametrize(("rows", "columns"), [(2, 3), (3, 70)])
def test_every_cell_has_its_two_triangles_once(rows: int, columns: int) -> None:
    vertices, indices = grid(rows, columns)
    corners = vertices[indices.reshape(-1, 6)] * (columns, rows)
    first = np.rint(corners[:, 0]).astype(int)
    assert sorted(map(tuple, first.tolist())) == [(i, j) for i in range(columns) for j in range(rows)]
    steps = np.array([(0, 0), (1, 0), (0, 1), (0, 1), (1, 0), (1, 1)])
    assert np.allclose(corners - corners[:, :1], steps, atol=1e-4)
