"""A sweep as a table, as CSV and as a self-contained HTML page."""

import base64
import csv
import html
import io
from collections.abc import Sequence

from seafoam.accuracy.model import Causes, MeasuredPoint, Sweep

COLUMNS = (
    "id", "tier", "owner", "parameter", "value", "cause", "on_front", "beaten_by",
    "time_ms", "time_low_ms", "time_high_ms",
    "rounds_ms", "fixed_ms", "ns_per_pixel", "rmse", "max", "flip", "coverage", "flipped", "popping", "geometry",
    "filtering", "precision", "rest", "quality", "plan", "scene",
)  # fmt: skip

HEADINGS = (
    "quality", "front", "time, ms", "quartiles", "RMSE", "max", "FLIP", "coverage", "flipped", "popping", "geometry",
    "filtering", "precision", "rest",
)  # fmt: skip

NOTES = (
    "Time: from the first call of a frame until it is finished, without readback and encoding; median and quartiles "
    "of rounds in which all points are drawn in turn.",
    "RMSE and max: linear RGB clipped at display white, in levels of 255, against the converged float64 picture. "
    "FLIP: mean, of tone-mapped sRGB. Coverage: RMSE of foam coverage. Flipped: fraction of pixels that have foam in "
    "only one picture.",
    "Popping: maximum fraction of the foam that disappears within 1/60 s. Some foam of the sea disappears in truth: "
    "compare with tier reference.",
    "Geometry, filtering, precision: reduction of the RMSE when only the settings of that cause are as in tier "
    "reference; rest: error that remains when all are. Causes mask each other, so the reductions need not add up and "
    "can be negative.",
)


def csv_of(sweep: Sweep) -> str:
    """Return a header and one line per point."""
    buffer = io.StringIO()
    writer = csv.writer(buffer, lineterminator="\n")
    writer.writerow(COLUMNS)
    for point in sweep.points:
        parameter = point.parameter
        causes = dict.fromkeys(Causes.model_fields) if point.causes is None else point.causes.model_dump()
        figures = (*point.error.model_dump().values(), *causes.values())
        writer.writerow(
            [
                point.id,
                point.tier,
                *((parameter.owner, parameter.pointer, parameter.value, parameter.cause) if parameter else (None,) * 4),
                int(point.on_front),
                " ".join(point.beaten_by),
                *(round(value, 4) for value in (point.time.median_ms, point.time.low_ms, point.time.high_ms)),
                " ".join(f"{value:g}" for value in point.time.rounds_ms),
                round(point.model.fixed_ms, 4),
                round(point.model.ns_per_pixel, 3),
                *(None if value is None else f"{value:.6g}" for value in figures),
                # What differs from the parameters' defaults.
                point.quality.model_dump_json(exclude_defaults=True),
                point.plan,
                sweep.scene_sha256,
            ]
        )
    return buffer.getvalue()


def row_of(point: MeasuredPoint) -> tuple[str, ...]:
    """Return a point's cells, under :data:`HEADINGS`."""
    time, error, causes = point.time, point.error, point.causes
    return (
        point.id,
        "*" if point.on_front else "",
        milliseconds(time.median_ms),
        f"{milliseconds(time.low_ms)}–{milliseconds(time.high_ms)}",
        f"{error.rmse:.2f}",
        f"{error.max:.0f}",
        f"{error.flip:.4f}",
        f"{error.coverage:.4f}",
        f"{100 * error.flipped:.2f} %",
        "" if error.popping is None else f"{100 * error.popping:.1f} %",
        *(4 * ("",) if causes is None else _cells(causes)),
    )


def _cells(causes: Causes) -> tuple[str, ...]:
    falls = (f"{round(value, 2) + 0.0:+.2f}" for value in (causes.geometry, causes.filtering, causes.precision))
    return (*falls, f"{causes.rest:.2f}")


def milliseconds(value: float) -> str:
    """Format to about three digits."""
    return f"{value:.0f}" if value >= 100 else f"{value:.1f}" if value >= 10 else f"{value:.2f}"


def page(sweep: Sweep, command: str) -> str:
    """Return one HTML file with plot, table, summary, machine and command."""
    from seafoam.accuracy.plots import plot_sweep

    machine, timing = sweep.machine, sweep.timing
    plot = base64.b64encode(plot_sweep(sweep)).decode()
    name = sweep.preset or "a scene"
    threads = f"{machine.threads} of {machine.cores} cores"
    about = (
        ("command", command),
        ("renderer", f"{machine.renderer}, {machine.version}"),
        ("processor", f"{machine.processor}, {threads}"),
        ("measured", f"{sweep.measured_at}, in {sweep.seconds:.0f} s, {timing.rounds} rounds"),
        ("time of the scene", f"{sweep.time:g} s"),
        ("times", f"of frames of {timing.own_width} × {timing.own_height}, {timing.timer} clock"),
        (
            "predicted from",
            f"frames of {timing.width} × {timing.height} and {timing.small_width} × {timing.small_height} per round; "
            f"slow points from frames of {sweep.width} × {sweep.height}",
        ),
        ("compared at", f"{sweep.width} × {sweep.height} with {sweep.truth.samples} samples per pixel in float64"),
        ("versions", ", ".join(f"{package} {number}" for package, number in sweep.versions.items())),
    )
    rows = [row_of(point) for point in sweep.points]
    marks = ["front" if point.on_front else "" for point in sweep.points]
    parts = [
        "<!doctype html>",
        '<html lang="en"><meta charset="utf-8"><meta name="viewport" content="width=device-width">',
        f"<title>Cost of accuracy: {html.escape(name)}</title>",
        f"<style>{_STYLE}</style>",
        f"<h1>Cost of accuracy: {html.escape(name)}</h1>",
        f'<img alt="Time against error" src="data:image/png;base64,{plot}">',
        "<h2>Along the front</h2>",
        _list(sweep.sentences),
        "<h2>Tiers</h2>",
        _list([_standing(sweep, point) for point in sweep.points if point.tier is not None]),
        "<h2>Single settings</h2>",
        "<p>Steps from a value to the next more exact one, all other settings as in tier standard.</p>",
        _list([step.sentence + _worth(step.error_per_ms) for step in sweep.steps]),
        "<h2>All points</h2>",
        _table(HEADINGS, rows, marks),
        *(f"<p>{html.escape(note)}</p>" for note in NOTES),
        "<h2>Method</h2>",
        "<dl>" + "".join(f"<dt>{what}<dd>{html.escape(said)}" for what, said in about) + "</dl>",
    ]
    return "\n".join(parts) + "\n"


def _standing(sweep: Sweep, point: MeasuredPoint) -> str:
    """Describe a tier relative to all other points."""
    if not point.beaten_by:
        return f"{point.id}: no measured point is as exact and faster by a tenth"
    better = [sweep.point(id) for id in point.beaten_by[:3]]
    told = ", ".join(f"{one.id} ({milliseconds(one.time.median_ms)} ms, {one.error.rmse:.2f})" for one in better)
    return f"{point.id} ({milliseconds(point.time.median_ms)} ms, {point.error.rmse:.2f}) is beaten by {told}"


def _worth(error_per_ms: float | None) -> str:
    return "" if error_per_ms is None else f" ({error_per_ms:+.3g} levels of RMSE removed per millisecond)"


def _list(lines: Sequence[str]) -> str:
    return "<ul>" + "".join(f"<li>{html.escape(line)}" for line in lines) + "</ul>"


def _table(headings: Sequence[str], rows: Sequence[Sequence[str]], marks: Sequence[str]) -> str:
    head = "".join(f"<th>{html.escape(heading)}" for heading in headings)
    lines = [
        f'<tr class="{mark}">' + "".join(f"<td>{html.escape(cell)}" for cell in row)
        for row, mark in zip(rows, marks, strict=True)
    ]
    return f"<div><table><tr>{head}\n" + "\n".join(lines) + "</table></div>"


_STYLE = (
    "body{font:15px/1.5 system-ui,sans-serif;color:#1c2b33;max-width:1100px;margin:2em auto;padding:0 1em}"
    "img{width:100%}div{overflow-x:auto}table{border-collapse:collapse;font-size:13px}"
    "td,th{padding:.2em .6em;text-align:right;border-bottom:1px solid #dde3e6;white-space:nowrap}"
    "td:first-child,th:first-child{text-align:left}tr.front{background:#eef6f2;font-weight:600}"
    "dt{font-weight:600;float:left;clear:left;width:11em}dd{margin:0 0 .2em 11em}"
)
