"""Plot of time against error. Uses only matplotlib's object interface, as threads of a server must."""

from collections.abc import Iterator
from typing import Any

from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.transforms import Bbox

from seafoam.accuracy.model import MeasuredPoint, Sweep
from seafoam.masks.judge.plots import INK, png, tidy

_FAINT = "#8a979e"
_COLOURS = {"tier": "#b5353c", "geometry": "#1f3a73", "filtering": "#2a9d78", "precision": "#e0912f"}
_MARKERS = {"tier": "s", "geometry": "o", "filtering": "D", "precision": "^"}


def plot_sweep(sweep: Sweep) -> bytes:
    """PNG (1500 x 1050): every point at its time and RMSE with the quartiles of its time, the front as a line."""
    figure = Figure(figsize=(10.0, 7.0), dpi=150, layout="constrained")
    canvas = FigureCanvasAgg(figure)
    axes = figure.subplots()
    axes.set_xscale("log")
    axes.set_yscale("log")
    best = [sweep.point(id) for id in sweep.front]
    axes.plot(
        [point.time.median_ms for point in best],
        [_shown(point) for point in best],
        color=INK,
        lw=1.2,
        drawstyle="steps-post",
        label="front: no point is faster and more exact",
        zorder=1,
    )
    for kind in _COLOURS:
        own = [point for point in sweep.points if _kind(point) == kind]
        if not own:
            continue
        times = [point.time.median_ms for point in own]
        spread = [
            [max(0.0, point.time.median_ms - point.time.low_ms) for point in own],
            [max(0.0, point.time.high_ms - point.time.median_ms) for point in own],
        ]
        axes.errorbar(
            times,
            [_shown(point) for point in own],
            xerr=spread,
            fmt=_MARKERS[kind],
            ms=6.5 if kind == "tier" else 5.0,
            color=_COLOURS[kind],
            elinewidth=0.8,
            alpha=0.9,
            label=kind if kind == "tier" else f"{kind} setting",
            zorder=3 if kind == "tier" else 2,
        )
    timing = sweep.timing
    axes.set_xlabel(
        f"frame time at {timing.own_width} × {timing.own_height}, ms ({timing.timer} clock, median, quartiles)"
    )
    axes.set_ylabel(f"RMSE against float64 at {sweep.width} × {sweep.height}, levels (white = 255)")
    axes.set_title(f"Cost of accuracy: {sweep.preset or 'a scene'}", loc="left", color=INK)
    axes.set_title(sweep.machine.renderer, loc="right", color=_FAINT, fontsize="small")
    axes.legend(frameon=False, fontsize="small", loc="best")
    tidy(axes, "both")
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_major_formatter(_plain)
        axis.set_minor_formatter(_plain)
    axes.tick_params(which="minor", labelsize=6.5)
    figure.draw_without_rendering()
    _label(axes, canvas, sweep)
    return png(figure)


def _plain(value: float, _: object) -> str:
    return f"{value:g}" if f"{value:.0e}"[0] in "1235" else ""


def _kind(point: MeasuredPoint) -> str:
    return point.parameter.cause if point.parameter else "tier"


def _shown(point: MeasuredPoint) -> float:
    """Replace an error of 0, which a logarithmic axis cannot show."""
    return max(point.error.rmse, 1e-3)


def _label(axes: Axes, canvas: FigureCanvasAgg, sweep: Sweep) -> None:
    """Label the points, the front and the tiers first, where there is room; a thin line leads to labels further off."""
    renderer = canvas.get_renderer()  # type: ignore[no-untyped-call]
    place = axes.transData
    taken: list[Bbox] = []
    for point in sweep.points:
        x, y = place.transform((point.time.median_ms, _shown(point)))
        taken.append(Bbox.from_bounds(x - 7, y - 7, 14, 14))
    legend = axes.get_legend()
    if legend is not None:
        taken.append(legend.get_window_extent(renderer))
    inside = axes.get_window_extent(renderer)
    important = sorted(sweep.points, key=lambda point: (not point.on_front, point.tier is None))
    for point in important:
        text: Any = axes.annotate(
            point.id,
            (point.time.median_ms, _shown(point)),
            xytext=(0, 0),
            textcoords="offset pixels",
            fontsize=7.0 if point.tier is None else 9.0,
            weight="bold" if point.tier else "normal",
            color=_COLOURS[_kind(point)],
            arrowprops={"arrowstyle": "-", "lw": 0.5, "color": _FAINT, "shrinkA": 0, "shrinkB": 3},
            va="center",
        )
        size = text.get_window_extent(renderer)
        x, y = place.transform((point.time.median_ms, _shown(point)))
        for dx, dy in _offsets(size.width):
            box = Bbox.from_bounds(x + dx, y + dy - size.height / 2, size.width, size.height)
            fits = inside.x0 <= box.x0 and box.x1 <= inside.x1 and inside.y0 <= box.y0 and box.y1 <= inside.y1
            if fits and not any(box.overlaps(other) for other in taken):
                text.set_position((dx, dy))
                taken.append(box)
                break
        else:
            text.remove()


def _offsets(width: float) -> Iterator[tuple[float, float]]:
    """Return positions for a label of this width around its point, the nearest first; pixels."""
    for distance in (12, 24, 40, 60, 85, 115, 150, 190, 235, 285, 340):
        yield distance, 0.7 * distance
        yield distance, -0.7 * distance
        yield distance, 0.0
        yield -width / 2, distance
        yield -width / 2, -distance
        yield -width - distance, 0.6 * distance
        yield -width - distance, -0.6 * distance
        yield -width - distance, 0.0
