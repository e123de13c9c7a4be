"""Pictures of masks and their spectra, as PNG files.

Only matplotlib's object interface is used: pyplot keeps global state, which threads of a server may not share.
"""

import io
from collections.abc import Sequence
from typing import Literal

import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from numpy.typing import NDArray

from seafoam.masks.judge.spectrum import LEAST_BINS, MaskSpectrum
from seafoam.masks.prefilter import SUBTEXELS, bspline_samples, quantile_lookup
from seafoam.masks.torus import Ranks

SHEET_GREYS: tuple[float, ...] = (0.1, 0.25, 0.5)
SHEET_TILES = 2
SHEET_TEXELS = 144
"""Side of the square, centred on the corner where four tiles meet, that the sheet shows at two pixels a texel."""
CLOSE_TEXELS = 48
INK = "#1c2b33"
"""Colour of text and axes."""
_COLOURS = ("#1f3a73", "#3d8fd1", "#2a9d78", "#e0912f", "#b5353c")
_HIGHEST_FREQUENCY = 0.72
_LINEAR_PEAK = 10.0
"""RAPS that peak above this are drawn on a logarithmic axis, which starts at the next."""
_LOG_FLOOR = 0.01


def plot_spectrum(spectrum: MaskSpectrum, title: str = "") -> bytes:
    """PNG (1350 x 1050) of RAPS over anisotropy against radial frequency, one line a grey level.

    Triangles mark the principal frequencies of the levels; dashed lines are white noise and isotropy. The axes are
    fitted to the rings of at least ``spectrum.LEAST_BINS`` bins: the last few, in the corners of the frequency
    plane, hold only noise.
    """
    figure = Figure(figsize=(9.0, 7.0), dpi=150, layout="constrained")
    upper, lower = figure.subplots(2, 1, sharex=True, height_ratios=(3, 2))
    _draw_raps(upper, spectrum, width=1.1)
    upper.set_ylabel("RAPS (white noise = 1)")
    upper.legend(
        title="grey level (triangle: its principal frequency)",
        frameon=False,
        ncols=len(spectrum.greys),
        fontsize="small",
        title_fontsize="small",
        loc="lower right",
        bbox_to_anchor=(1.0, 1.0),
    )
    upper.set_title(title or "Mask spectrum", loc="left", color=INK)
    reference = spectrum.isotropic_reference
    for grey, colour in zip(spectrum.greys, _colours(spectrum), strict=True):
        lower.plot(spectrum.frequency, grey.anisotropy, color=colour, lw=0.7, alpha=0.85)
    lower.axhline(reference, color=INK, lw=0.9, ls="--", label=f"isotropic: {reference:.4g} dB")
    lower.legend(frameon=False, fontsize="small", loc="upper center")
    lower.set_ylim(reference - 10.0, reference + 14.0)
    lower.set_ylabel("anisotropy (dB)")
    lower.set_xlabel("radial frequency (cycles per texel); K = 1, the whole periodic tile")
    tidy(upper)
    tidy(lower)
    return png(figure)


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
        _draw_raps(axes, spectrum, width=0.8)
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


def _draw_raps(axes: Axes, spectrum: MaskSpectrum, width: float) -> None:
    axes.set_xlim(0.0, _HIGHEST_FREQUENCY)
    axes.axhline(1.0, color=INK, lw=0.9, ls="--")
    full = spectrum.bins >= LEAST_BINS
    peak = max(float(grey.raps[full].max()) for grey in spectrum.greys)
    logarithmic = peak > _LINEAR_PEAK
    floor = _LOG_FLOOR if logarithmic else 0.0
    for grey, colour in zip(spectrum.greys, _colours(spectrum), strict=True):
        axes.plot(spectrum.frequency, grey.raps, color=colour, lw=width, label=f"{grey.grey:.4g}")
        axes.plot([grey.principal_frequency], [floor], marker="^", ms=5, color=colour, clip_on=False, ls="none")
    if logarithmic:
        axes.set_yscale("log")
    axes.set_ylim(floor, peak * (1.5 if logarithmic else 1.08))


def _colours(spectrum: MaskSpectrum) -> list[str]:
    return [_COLOURS[index % len(_COLOURS)] for index in range(len(spectrum.greys))]


def tidy(axes: Axes, which: Literal["major", "both"] = "major") -> None:
    """Give axes a grid, of the major ticks or of all, and no frame above and to the right."""
    axes.spines[["top", "right"]].set_visible(False)
    axes.grid(color="#dde3e6", lw=0.6, which=which)
    axes.set_axisbelow(True)
    axes.tick_params(colors=INK, which=which)


def png(figure: Figure) -> bytes:
    """Return a figure as a PNG file."""
    buffer = io.BytesIO()
    FigureCanvasAgg(figure)
    figure.savefig(buffer, format="png")
    return buffer.getvalue()
