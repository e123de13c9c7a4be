"""Sheets of masks beside one another, as PNG files, for docs/masks.md."""

from collections.abc import Sequence

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray

from seafoam.masks.judge.plots import INK, draw_raps, png, tidy
from seafoam.masks.judge.spectrum import MaskSpectrum
from seafoam.masks.prefilter import SUBTEXELS, bspline_samples, quantile_lookup
from seafoam.masks.torus import Ranks

SHEET_GREYS: tuple[float, ...] = (0.1, 0.25, 0.5)
SHEET_TILES = 2
SHEET_TEXELS = 144
"""Side of the square, centred on the corner where four tiles meet, that the sheet shows at two pixels a texel."""
CLOSE_TEXELS = 48


def contact_sheet(masks: Sequence[tuple[str, Ranks, MaskSpectrum]]) -> bytes:
    """PNG with a row a mask: its patterns at :data:`SHEET_GREYS` and its RAPS.

    A pattern is cut from a 2 x 2 tiling about the corner where the tiles meet, so that a seam would cross its
    middle, at two pixels a texel.
    """
    dpi, gap, label = 100, 8, 26
    cell = 2 * SHEET_TEXELS
    plot_width = round(1.6 * cell)
    row_height = cell + gap + label
    width = len(SHEET_GREYS) * (cell + gap) + plot_width + 2 * gap
    height = len(masks) * row_height + gap
    figure = Figure(figsize=(width / dpi, height / dpi), dpi=dpi, facecolor="white")
    for row, (name, ranks, spectrum) in enumerate(masks):
        bottom = height - (row + 1) * row_height
        figure.text(gap / width, (bottom + cell + 7) / height, name, color=INK, fontsize=11, weight="bold")
        for column, grey in enumerate(SHEET_GREYS):
            box = ((gap + column * (cell + gap)) / width, bottom / height, cell / width, cell / height)
            axes = figure.add_axes(box)
            axes.imshow(corner_pattern(ranks, grey), cmap="gray", vmin=0, vmax=1, interpolation="nearest")
            axes.set_axis_off()
            axes.set_title(f"grey {grey:g}", fontsize=8, color=INK, pad=3, loc="right")
        left = gap + len(SHEET_GREYS) * (cell + gap) + 46
        axes = figure.add_axes(
            (left / width, (bottom + 34) / height, (width - left - gap) / width, (cell - 34) / height)
        )
        draw_raps(axes, spectrum, width=0.8)
        tidy(axes)
        axes.tick_params(labelsize=7)
        axes.set_title("RAPS against cycles per texel, by grey level", fontsize=8, color=INK, pad=3, loc="left")
        if row == 0:
            axes.legend(frameon=False, fontsize=7, ncols=2)
    return png(figure)


def magnified_sheet(masks: Sequence[tuple[str, Ranks, Sequence[float]]]) -> bytes:
    """PNG of masks (name, ranks, quantile table) as a close camera shows them: a column a mask, a row a grey level.

    Each cell is :data:`CLOSE_TEXELS` texels wide at eight pixels a texel: the cubic B-spline of the mask against
    the quantile of the grey level.
    """
    side = CLOSE_TEXELS * SUBTEXELS
    figure = Figure(figsize=(2.4 * len(masks), 2.4 * len(SHEET_GREYS) + 0.3), dpi=120, layout="constrained")
    grid = figure.subplots(len(SHEET_GREYS), len(masks), squeeze=False)
    for column, (name, ranks, quantile) in enumerate(masks):
        samples = bspline_samples(ranks)[:side, :side]
        for row, grey in enumerate(SHEET_GREYS):
            axes = grid[row, column]
            shown = samples < quantile_lookup(quantile, grey)
            axes.imshow(shown, cmap="gray", vmin=0, vmax=1, interpolation="antialiased")
            axes.set(xticks=[], yticks=[])
            if row == 0:
                axes.set_title(name, color=INK, fontsize=11, weight="bold")
            if column == 0:
                axes.set_ylabel(f"grey {grey:g}", color=INK, fontsize=9)
    return png(figure)


def corner_pattern(ranks: Ranks, grey: float) -> NDArray[np.bool_]:
    """The pattern of a grey level about the corner of four tiles; (SHEET_TEXELS, SHEET_TEXELS) or the tiling."""
    tiled = np.tile(ranks < grey * ranks.size, (SHEET_TILES, SHEET_TILES))
    size = ranks.shape[0]
    half = min(SHEET_TEXELS // 2, size)
    return tiled[size - half : size + half, size - half : size + half]
