"""The report: what was drawn and how fast, what was held to its truth, what the service gave, and what was left out."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from statistics import median

from bench.gpu.tasks import FIRST, Drawn, Judged
from bench.report import Column, Table, count, lines, ms
from support.parity import FLIPPED, NEAR, TONE, WHOLE

COSTLIEST = 4
WITHOUT = "**This machine drew without a GPU**: nothing below says what one does.\n\n"


@dataclass(frozen=True)
class Served:
    """What a server gave: frames a second to some clients, and median seconds of its stages."""

    what: str
    clients: int
    rate: float
    stages: Mapping[str, float]


@dataclass
class Report:
    """All that was found. ``distrust``: why times are not of timer queries, empty if they are."""

    about: dict[str, str]
    software: bool
    """Whether the renderer draws on the processor."""
    budget: float
    wanted: int
    """Pieces of work, without the service."""
    note: str = ""
    """What has to be known of the device's figures."""
    distrust: str = ""
    drawn: list[Drawn] = field(default_factory=list)
    judged: list[Judged] = field(default_factory=list)
    served: list[Served] = field(default_factory=list)
    failed: dict[str, str] = field(default_factory=dict)
    """What went wrong, by the piece of work."""
    skipped: dict[str, str] = field(default_factory=dict)
    """Why a piece of work was not done or not finished, by its name."""

    @property
    def wrong(self) -> dict[str, str]:
        """Failures, pictures that are none and frames too far from their truth."""
        every: list[Drawn | Judged] = [*self.drawn, *self.judged]
        found = {str(one.task): ", ".join(one.faults) for one in every if one.faults}
        return self.failed | found

    def summary(self) -> str:
        """One line."""
        right = sum(not one.faults for one in self.judged)
        return (
            f"{len(self.drawn)} preset and tier pairs drawn; {right} of {len(self.judged)} frames within the bounds of "
            f"the stored references; {len(self.wrong)} wrong, {len(self.skipped)} skipped"
        )


def page(report: Report, command: str) -> str:
    """The report as Markdown."""
    tables = [
        table
        for table in (tiers(report), passes(report), frames(report), parities(report), service(report))
        if table.rows
    ]
    parts = [
        f"""# A GPU's proof

{WITHOUT if report.software else ""}All presets at all tiers, parity against the stored float64 references
with the bounds of the tests, frame times and the throughput of the service, by one command within {report.budget:g} s,
on the machine below. This page is generated:

    {command}

{report.summary()}.

```
{lines(report.about)}
```
""",
        *([f"{report.note}\n"] if report.note else []),
        clock(report.distrust),
        *(f"## {table.title}\n\n```\n{_body(table)}\n```\n" for table in tables),
        _listed("Wrong", report.wrong, "Nothing: every picture that was drawn is one, and no bound is exceeded."),
        _listed("Skipped", report.skipped, "Nothing."),
    ]
    return "\n".join(parts)


def clock(distrust: str) -> str:
    """What the times are."""
    if distrust:
        return f"Times are wall time until GL has finished, not of timer queries: {distrust}.\n"
    return (
        "*GPU* is the sum of GL timer queries, one around each pass; *wall* is the clock from the first call until GL "
        "has\nfinished, with the program's own work for each pass. Rates are of the pictures' pixels, whatever the "
        "samples of each. A\nrow without *GPU* had queries that cannot be right (longer than the frame, or none).\n"
    )


def tiers(report: Report) -> Table:
    """A row for each tier and size: the middle preset and the slowest."""
    kinds: dict[str, list[Drawn]] = {}
    for one in report.drawn:
        kinds.setdefault(one.task.kind, []).append(one)
    rows = []
    for kind, drawn in kinds.items():
        slowest = max(drawn, key=lambda one: one.seconds)
        middle = median(one.seconds for one in drawn)
        rows.append((kind, len(drawn), middle, _rate(drawn[0], middle), slowest.task.preset, slowest.seconds))
    return Table(
        "Tiers",
        "Medians over the presets, and the slowest preset.",
        (
            Column("tier", "tier and size"),
            Column("presets", "presets", count),
            Column("seconds", "ms", ms),
            Column("rate", "Mpixel/s", _digits),
            Column("slowest", "slowest"),
            Column("most", "its ms", ms),
        ),
        rows,
    )


def passes(report: Report) -> Table:
    """A row for each preset at the usual tier: its costliest passes."""
    size = {one.task.size for one in report.drawn}
    timed = [one for one in report.drawn if one.passes and one.task.tier == FIRST and one.task.size == min(size)]
    return Table(
        "Passes",
        f"The {COSTLIEST} costliest kinds of passes of {FIRST}'s frames and what they take on the GPU, ms.",
        (Column("preset", "preset"), Column("passes", "passes")),
        [
            (
                one.task.preset,
                ", ".join(
                    f"{name} {1e3 * seconds:.2f}"
                    for name, seconds in sorted(one.passes.items(), key=lambda item: -item[1])[:COSTLIEST]
                ),
            )
            for one in sorted(timed, key=lambda one: one.task.preset)
        ],
    )


def frames(report: Report) -> Table:
    """A row for each preset, tier and size."""
    return Table(
        "Frames",
        "Each from its preset's own camera: medians of frames of different times, after the first. First: the first "
        "frame, which uploads and draws what is kept; ready: before it, plan, programs and textures made, while other "
        "presets were too.",
        (
            Column("preset", "preset"),
            Column("tier", "tier and size"),
            Column("gpu", "GPU, ms", ms),
            Column("wall", "wall, ms", ms),
            Column("rate", "Mpixel/s", _digits),
            Column("rounds", "frames", count),
            Column("first", "first, ms", ms),
            Column("ready", "ready, ms", ms),
        ),
        [
            (
                one.task.preset,
                one.task.kind,
                one.query,
                one.wall,
                _rate(one, one.seconds),
                one.rounds,
                one.first,
                one.ready,
            )
            for one in sorted(report.drawn, key=lambda one: one.task.preset)
        ],
    )


def parities(report: Report) -> Table:
    """A row for each frame that was held against its truth."""
    return Table(
        "Parity",
        "Frames without maps and filters against the float64 frames in tests/references, of the same samples. RMSE in "
        f"levels: below 1°, without the worst pixel in ten thousand, at most {NEAR:g}; whole, at most {WHOLE:g}. "
        f"Of hard looks of foam: flipped samples, at most {100 * FLIPPED:g} %; tone, at most {100 * TONE:g} %.",
        (
            Column("preset", "preset"),
            Column("time", "time, s", "{:.10g}".format),
            Column("size", "size"),
            Column("near", "below 1°", "{:.3f}".format),
            Column("whole", "whole", "{:.3f}".format),
            Column("flipped", "flipped", _percent),
            Column("tone", "tone", _percent),
            Column("held", "within"),
        ),
        [
            (
                one.task.preset,
                one.task.time,
                f"{one.parity.size[0]} × {one.parity.size[1]}",
                one.parity.near,
                one.parity.whole,
                one.parity.flipped if one.parity.hard else None,
                one.parity.tone if one.parity.hard else None,
                "no" if one.faults else "yes",
            )
            for one in sorted(report.judged, key=lambda one: (one.task.preset, one.task.time))
        ],
    )


def service(report: Report) -> Table:
    """A row for each load."""
    stages = ("queue", "plan", "render", "read", "encode", "http")
    return Table(
        "Service",
        "A server as seafoam serve starts it, but without caches of frames and with a longer deadline; each client "
        "asks for a frame of another time as soon as it is answered. Medians of the server's stages; http: the rest, "
        "as the client sees it.",
        (
            Column("what", "what"),
            Column("clients", "clients", count),
            Column("rate", "frames/s", _digits),
            *(Column(stage, f"{stage}, ms", ms) for stage in stages),
        ),
        [(one.what, one.clients, one.rate, *(one.stages.get(stage) for stage in stages)) for one in report.served],
    )


def _body(table: Table) -> str:
    return table.text().partition("\n")[2]


def _listed(title: str, found: Mapping[str, str], none: str) -> str:
    return (
        "\n".join([f"## {title}\n", *(f"- {what}: {why}" for what, why in found.items()), *([] if found else [none])])
        + "\n"
    )


def _rate(one: Drawn, seconds: float) -> float:
    """Millions of pixels a second."""
    width, height = one.task.size
    return 1e-6 * width * height / seconds


def _digits(value: float) -> str:
    return f"{value:,.0f}" if value >= 100 else f"{value:.1f}" if value >= 1 else f"{value:.3f}"


def _percent(share: float) -> str:
    return f"{100.0 * share:.3f} %"
