"""Plot of time against error. Uses only matplotlib's object interface, as threads of a server must."""

from matplotlib.figure import Figure

from seafoam.accuracy.model import MeasuredPoint, Sweep
from seafoam.accuracy.timing import told
from seafoam.masks.judge.plots import INK, png, tidy

_FAINT = "#8a979e"
_COLOURS = {"tier": "#b5353c", "geometry": "#1f3a73", "filtering": "#2a9d78", "precision": "#e0912f"}
_MARKERS = {"tier": "s", "geometry": "o", "filtering": "D", "precision": "^"}


def plot_sweep(sweep: Sweep) -> bytes:
    """PNG (1500 x 1050): every point at its time and RMSE with the quartiles of its time, the front as a line.

    The tiers, and points of the front that err notably less than the one before, have their names.
    """
    figure = Figure(figsize=(10.0, 7.0), dpi=150, layout="constrained")
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
    for point in (point for point in told(best) if point.tier is None):
        axes.annotate(
            point.id, _place(point), (6, 4), fontsize=7.0, color=_COLOURS[_kind(point)], textcoords="offset points"
        )
    # Nothing is faster and more exact than a point of the front: below it to the left is room.
    for point in (point for point in sweep.points if point.tier is not None):
        axes.annotate(
            point.id, _place(point), (-5, -5), ha="right", va="top", color=_COLOURS["tier"], textcoords="offset points"
        )
    return png(figure)


def _plain(value: float, _: object) -> str:
    return f"{value:g}" if f"{value:.0e}"[0] in "1235" else ""


def _kind(point: MeasuredPoint) -> str:
    return point.parameter.cause if point.parameter else "tier"


def _place(point: MeasuredPoint) -> tuple[float, float]:
    return point.time.median_ms, _shown(point)


def _shown(point: MeasuredPoint) -> float:
    """Replace an error of 0, which a logarithmic axis cannot show."""
    return max(point.error.rmse, 1e-3)
