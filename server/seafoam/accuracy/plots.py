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
    )
    for kind in _COLOURS:
        own = [point for point in sweep.points if _kind(point) == kind]
        if not own:
            continue
        times = [point.time for point in own]
        quartiles = [time.low_ms for time in times], [time.high_ms for time in times]
        axes.errorbar(
            [time.median_ms for time in times],
            [_shown(point) for point in own],
            # Of equal times the quartiles may be apart from the median by their rounding, either way.
            xerr=[[abs(time.median_ms - end) for time, end in zip(times, ends, strict=True)] for ends in quartiles],
            fmt=_MARKERS[kind],
            color=_COLOURS[kind],
            elinewidth=0.8,
            label=kind if kind == "tier" else f"{kind} setting",
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
    worth = [point.id for point in told(best)]
    for point in (point for point in sweep.points if point.tier or point.id in worth):
        # Nothing is faster and more exact than a point of the front: below it to the left is room.
        place, side = ((-5, -5), "right") if point.tier else ((6, 4), "left")
        at, colour = (point.time.median_ms, _shown(point)), _COLOURS[_kind(point)]
        axes.annotate(point.id, at, place, ha=side, va="center", color=colour, textcoords="offset points")
    return png(figure)


def _plain(value: float, _: object) -> str:
    return f"{value:g}" if f"{value:.0e}"[0] in "1235" else ""


def _kind(point: MeasuredPoint) -> str:
    return point.parameter.cause if point.parameter else "tier"


def _shown(point: MeasuredPoint) -> float:
    """Replace an error of 0, which a logarithmic axis cannot show."""
    return max(point.error.rmse, 1e-3)
