"""The cells of a grid, as it is given to a driver."""

import numpy as np
import pytest

from seafoam.render.gl.executor import grid


@pytest.mark.parametrize(("rows", "columns"), [(2, 3), (3, 70)])
def test_every_cell_has_its_two_triangles_once(rows: int, columns: int) -> None:
    vertices, indices = grid(rows, columns)
    corners = vertices[indices.reshape(-1, 6)] * (columns, rows)
    first = np.rint(corners[:, 0]).astype(int)
    assert sorted(map(tuple, first.tolist())) == [(i, j) for i in range(columns) for j in range(rows)]
    steps = np.array([(0, 0), (1, 0), (0, 1), (0, 1), (1, 0), (1, 1)])
    assert np.allclose(corners - corners[:, :1], steps, atol=1e-4)
