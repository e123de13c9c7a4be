"""Passes as bars. Only matplotlib's object interface is used, and a file's bytes depend on the figures alone."""

import io
from collections import Counter
from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.patches import Patch
from PIL import Image

from bench.drawn.passes import Frame
from bench.report import ms

_INK = "#1c2b33"
_FAINT = "#8a979e"
_GRID = "#dde3e6"
_KEPT = "#c9d1d5"
_OTHERS = "#a9b4ba"
_COLOURS = ("#1f3a73", "#b5353c", "#2a9d78", "#e0912f", "#6b4c9a", "#3a8fb7", "#8c6d31", "#d4739c")
"""Colours of the kinds of passes with the greatest total time over all presets."""
_LEAST_LABEL = 0.005
"""Share of the longest bar below which a bar has no visible length."""


def one_frame(frame: Frame) -> bytes:
    """WebP: a bar for each kind of pass, in drawing order; those drawn only once are pale."""
    kinds = frame.kinds()
    figure = Figure(figsize=(9.0, 0.9 + 0.27 * len(kinds)), dpi=90, layout="constrained")
    axes = figure.subplots()
    longest = max(seconds for _, _, seconds, _ in kinds)
    for place, (_, _, seconds, kept) in enumerate(kinds):
        axes.barh(place, 1000.0 * seconds, height=0.72, color=_KEPT if kept else _COLOURS[0])
        share = "once" if kept else f"{100.0 * seconds / frame.drawn:.1f} %"
        axes.annotate(
            f"{ms(seconds)} ms, {share}",
            (1000.0 * seconds, place),
            xytext=(4, 0),
            textcoords="offset points",
            va="center",
            fontsize=8,
            color=_FAINT if kept or seconds < _LEAST_LABEL * longest else _INK,
        )
    axes.set_yticks(range(len(kinds)), [f"{kind} × {count}" if count > 1 else kind for kind, count, _, _ in kinds])
    axes.set_xlim(0.0, 1220.0 * longest)
    _finish(axes)
    axes.set_title(frame.preset, loc="left", color=_INK, fontsize=10)
    axes.set_title(f"whole frame {ms(frame.whole)} ms", loc="right", color=_FAINT, fontsize=8)
    return _webp(figure)


def every_frame(frames: Sequence[Frame]) -> bytes:
    """WebP: a bar for each preset, divided into the passes that every frame draws, and labelled with their time."""
    totals: Counter[str] = Counter()
    for frame in frames:
        for kind, _, seconds, kept in frame.kinds():
            if not kept:
                totals[kind] += seconds / frame.drawn
    named = [kind for kind, _ in totals.most_common(len(_COLOURS))]
    figure = Figure(figsize=(10.0, 1.4 + 0.24 * len(frames)), dpi=110, layout="constrained")
    axes = figure.subplots()
    for place, frame in enumerate(frames):
        drawn = {kind: seconds for kind, _, seconds, kept in frame.kinds() if not kept}
        others = sum(seconds for kind, seconds in drawn.items() if kind not in named)
        left = 0.0
        for colour, seconds in [
            *((colour, drawn.get(kind, 0.0)) for kind, colour in zip(named, _COLOURS, strict=False)),
            (_OTHERS, others),
        ]:
            share = 100.0 * seconds / frame.drawn
            axes.barh(place, share, left=left, height=0.76, color=colour)
            left += share
        axes.annotate(
            f"{ms(frame.drawn)} ms",
            (100.0, place),
            xytext=(4, 0),
            textcoords="offset points",
            va="center",
            fontsize=8,
            color=_INK,
        )
    legend = [*zip(named, _COLOURS, strict=False), ("others", _OTHERS)]
    figure.legend(
        [Patch(color=colour) for _, colour in legend],
        [kind for kind, _ in legend],
        frameon=False,
        fontsize="small",
        loc="outside right upper",
    )
    axes.set_yticks(range(len(frames)), [frame.preset for frame in frames])
    _finish(axes)
    axes.set_xlim(0.0, 108.0)
    axes.set_xlabel("% of the passes that a frame draws", color=_INK, fontsize=9)
    axes.set_title("What a frame is made of", loc="left", color=_INK)
    return _webp(figure)


def _finish(axes: Axes) -> None:
    axes.invert_yaxis()
    axes.spines[["top", "right"]].set_visible(False)
    axes.grid(axis="x", color=_GRID, lw=0.6)
    axes.set_axisbelow(True)
    axes.tick_params(colors=_INK, labelsize=8.5)


def _webp(figure: Figure) -> bytes:
    canvas = FigureCanvasAgg(figure)
    canvas.draw()
    buffer = io.BytesIO()
    Image.fromarray(np.asarray(canvas.buffer_rgba())).convert("RGB").save(buffer, "WEBP", lossless=True, method=6)
    return buffer.getvalue()
