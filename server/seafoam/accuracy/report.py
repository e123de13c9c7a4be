"""A sweep as a table, as CSV and as a self-contained HTML page."""

import base64
import csv
import html
import io
from collections.abc import Sequence
from pathlib import Path
from string import Template

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


def csv_of(sweep: Sweep) -> str:
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
    return f"{value:.0f}" if value >= 100 else f"{value:.1f}" if value >= 10 else f"{value:.2f}"


def page(sweep: Sweep, command: str) -> str:
    """Return one HTML file with plot, table, summary, machine and command."""
    from seafoam.accuracy.plots import plot_sweep

    machine, timing = sweep.machine, sweep.timing
    about = (
        ("command", command),
        ("renderer", f"{machine.renderer}, {machine.version}"),
        ("processor", f"{machine.processor}, {machine.threads} of {machine.cores} cores"),
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
    template = Template(Path(__file__).with_name("report.html").read_text(encoding="utf-8"))
    return template.substitute(
        name=html.escape(sweep.preset or "a scene"),
        plot=base64.b64encode(plot_sweep(sweep)).decode(),
        sentences=_list(sweep.sentences),
        tiers=_list([_standing(sweep, point) for point in sweep.points if point.tier is not None]),
        steps=_list([step.sentence + _worth(step.error_per_ms) for step in sweep.steps]),
        points=_table(sweep.points),
        about="".join(f"<dt>{what}<dd>{html.escape(said)}" for what, said in about),
    )


def _standing(sweep: Sweep, point: MeasuredPoint) -> str:
    if not point.beaten_by:
        return f"{point.id}: no measured point is as exact and faster by a tenth"
    better = [sweep.point(id) for id in point.beaten_by[:3]]
    told = ", ".join(f"{one.id} ({milliseconds(one.time.median_ms)} ms, {one.error.rmse:.2f})" for one in better)
    return f"{point.id} ({milliseconds(point.time.median_ms)} ms, {point.error.rmse:.2f}) is beaten by {told}"


def _worth(error_per_ms: float | None) -> str:
    return "" if error_per_ms is None else f" ({error_per_ms:+.3g} levels of RMSE removed per millisecond)"


def _list(lines: Sequence[str]) -> str:
    return "<ul>" + "".join(f"<li>{html.escape(line)}" for line in lines) + "</ul>"


def _table(points: Sequence[MeasuredPoint]) -> str:
    head = "".join(f"<th>{html.escape(heading)}" for heading in HEADINGS)
    lines = [
        f'<tr class="{"front" * point.on_front}">' + "".join(f"<td>{html.escape(cell)}" for cell in row_of(point))
        for point in points
    ]
    return f"<div><table><tr>{head}\n" + "\n".join(lines) + "</table></div>"
