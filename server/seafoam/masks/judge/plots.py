"""Pictures of masks and their spectra, as PNG files.

Only matplotlib's object interface is used: pyplot keeps global state, which threads of a server may not share.
"""

import io
from itertools import cycle
from typing import Literal

from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from seafoam.masks.judge.spectrum import LEAST_BINS, MaskSpectrum

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
    draw_raps(upper, spectrum, width=1.1)
    upper.set_ylabel("RAPS (white noise = 1)")
    upper.legend(title="grey level (triangle: its principal frequency)", frameon=False, ncols=2, fontsize="small")
    upper.set_title(title or "Mask spectrum", loc="left", color=INK)
    for grey, colour in zip(spectrum.greys, cycle(_COLOURS), strict=False):
        lower.plot(spectrum.frequency, grey.anisotropy_db, color=colour, lw=0.7, alpha=0.85)
    lower.axhline(0.0, color=INK, lw=0.9, ls="--", label="isotropic: 0 dB")
    lower.legend(frameon=False, fontsize="small", loc="upper center")
    lower.set_ylim(-10.0, 14.0)
    lower.set_ylabel("anisotropy (dB)")
    lower.set_xlabel("radial frequency (cycles per texel); K = 1, the whole periodic tile")
    tidy(upper)
    tidy(lower)
    return png(figure)


def draw_raps(axes: Axes, spectrum: MaskSpectrum, width: float) -> None:
    """Draw the RAPS of all grey levels, and a mark at each principal frequency; width: of the lines, points."""
    axes.set_xlim(0.0, _HIGHEST_FREQUENCY)
    axes.axhline(1.0, color=INK, lw=0.9, ls="--")
    full = spectrum.bins >= LEAST_BINS
    peak = max(float(grey.raps[full].max()) for grey in spectrum.greys)
    logarithmic = peak > _LINEAR_PEAK
    floor = _LOG_FLOOR if logarithmic else 0.0
    for grey, colour in zip(spectrum.greys, cycle(_COLOURS), strict=False):
        axes.plot(spectrum.frequency, grey.raps, color=colour, lw=width, label=f"{grey.grey:.4g}")
        axes.plot([grey.principal_frequency], [floor], marker="^", ms=5, color=colour, clip_on=False, ls="none")
    if logarithmic:
        axes.set_yscale("log")
    axes.set_ylim(floor, peak * (1.5 if logarithmic else 1.08))


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
