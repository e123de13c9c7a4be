"""Frames over HTTP: time of a request by stage, cost of the formats, and frames per second."""

import itertools
from collections.abc import Iterator, Sequence
from statistics import median, quantiles
from typing import get_args

from bench.report import Column, Table, count, ms
from bench.served.server import Answer, closed_loop, connected, sure
from bench.watch import Watch
from seafoam.render.encode import FRAME_FORMATS
from seafoam.scene import Look, load_preset

PRESET = "default"
STAGES = ("queue", "plan", "render", "read", "encode")
CLIENTS = (1, 4)
THROUGHPUT_SECONDS = 10.0


def measure(port: int, watch: Watch) -> list[Table]:
    """Request frames, each at a different time so that none is cached, and tabulate the responses."""
    moments = (f"time={9.0 + 0.37 * index:.2f}" for index in itertools.count())
    with connected(port) as connection:
        for format in FRAME_FORMATS:
            sure(connection, f"/api/frames/{PRESET}.{format}?{next(moments)}")
        warm: dict[str, list[Answer]] = {format: [] for format in FRAME_FORMATS}
        for _ in watch.rounds("requests by format", 15, 25.0):
            for format in FRAME_FORMATS:
                warm[format].append(sure(connection, f"/api/frames/{PRESET}.{format}?{next(moments)}"))
        foam = load_preset(PRESET).scene.foam
        assert foam is not None
        unseen = [look for look in get_args(Look) if look != foam.look]
        fresh = [
            sure(connection, f"/api/frames/{PRESET}.png?{next(moments)}&look={unseen[index]}")
            for index in watch.rounds("requests with a new look", len(unseen), 15.0)
        ]
    return [_stages(warm, fresh), _throughput(port, moments, watch)]


def _stages(warm: dict[str, list[Answer]], fresh: Sequence[Answer]) -> Table:
    named = [*((format, answers) for format, answers in warm.items()), ("png, a look not drawn before", fresh)]
    width, height = load_preset(PRESET).size
    return Table(
        "A frame over HTTP",
        f"Preset {PRESET}, {width} x {height}, quality standard, one client; medians, ms. HTTP: the client's wall "
        "time less all stages; queue holds the way to the worker and back.",
        (
            Column("format", "format"),
            Column("http", "HTTP", ms),
            *(Column(stage, stage, ms) for stage in STAGES),
            Column("wall", "wall", ms),
            Column("bytes", "bytes", count),
            Column("requests", "requests", count),
        ),
        [
            (
                name,
                median(answer.http for answer in answers),
                *(median(answer.stages[stage] for answer in answers) for stage in STAGES),
                median(answer.wall for answer in answers),
                round(median(answer.size for answer in answers)),
                len(answers),
            )
            for name, answers in named
        ],
    )


def _throughput(port: int, moments: Iterator[str], watch: Watch) -> Table:
    rows = []
    for clients in CLIENTS:
        paths = (f"/api/frames/{PRESET}.png?{moment}" for moment in moments)
        with watch.step(f"frames a second, {clients} at once"):
            answers, elapsed = closed_loop(port, paths, clients, watch.seconds(THROUGHPUT_SECONDS))
        good = [answer.wall for answer in answers if answer.status == 200]
        slow = quantiles(good, n=10, method="inclusive")[-1] if len(good) > 1 else None
        rows.append(
            (clients, len(good) / elapsed, median(good) if good else None, slow, len(good), len(answers) - len(good))
        )
    return Table(
        "Frames a second",
        f"PNG frames as above, asked for by several clients at once for {watch.seconds(THROUGHPUT_SECONDS):g} s.",
        (
            Column("clients", "clients", count),
            Column("frames_per_second", "frames/s", lambda value: f"{value:.2f}"),
            Column("wall", "median, ms", ms),
            Column("wall_90", "slowest tenth from, ms", ms),
            Column("frames", "frames", count),
            Column("refused", "refused", count),
        ),
        rows,
    )
