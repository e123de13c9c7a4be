"""A sweep: every point of a scene drawn in turn, round after round, timed, and compared with the float64 picture.

Rounds visit all points, so that a slowdown of the machine affects all of them; a round's frames are 1/60 s after
the last round's, so they are also the sequence in which popping is counted. A frame is drawn once untimed just before
it is timed, which compiles and allocates; after that, only if it is so short that caches matter.
"""

import os
import platform
import time as clock
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from datetime import UTC, datetime
from importlib.metadata import version
from pathlib import Path
from statistics import median, quantiles
from typing import get_args

import numpy as np

from seafoam.accuracy import metrics
from seafoam.accuracy.cache import Store, key_of
from seafoam.accuracy.fronts import beating, compare, front, sentences
from seafoam.accuracy.knobs import idealised
from seafoam.accuracy.metrics import Picture
from seafoam.accuracy.model import (
    FORMAT,
    Causes,
    Machine,
    MeasuredPoint,
    Point,
    Step,
    Sweep,
    TimeModel,
    TimeSpread,
    Timing,
    TruthInfo,
)
from seafoam.accuracy.points import chains, plan_sha256, points_of, shown
from seafoam.accuracy.truth import StoppedError, make_truth
from seafoam.effects.effect import Cause
from seafoam.quality import Quality
from seafoam.reference import scene_sha256
from seafoam.render.service.jobs import Draw, Drawn, MeasureJob
from seafoam.scene.models import Scene
from seafoam.scene.presets import load_preset, preset_names

FRAME_SECONDS = 1.0 / 60.0

ENOUGH_SECONDS = 0.02
"""Minimum time of a frame of tier standard at the timing size, so that the cost of a call is negligible."""

LEAST_SHARE = 4
"""The timing size is at least the subject's own over this, along each side: in a much smaller one the cost per pixel
would be hidden by maps and tiles, which cost the same at every size."""

LONG_MS = 200.0
"""Time above which a frame is not drawn once more before it is timed."""

SLOW_MS = 100.0
"""If the pixels of the compared picture take longer, that picture is timed instead of one of the timing size."""

SMALL = 10
"""Ratio of the two sizes of the time model along each side."""

COMPILE_WEIGHT = 6.0
"""Time to compile a plan, in frames of one sample per pixel; used only for the progress."""

Measure = Callable[[MeasureJob], tuple[Drawn, ...]]


@dataclass(frozen=True)
class Subject:
    """The scene to measure. ``size``: frame size for which times are reported, pixels."""

    preset: str | None
    scene: Scene
    time: float
    size: tuple[int, int]

    @staticmethod
    def of_preset(name: str) -> "Subject":
        """Return the subject of a preset. Raises ``KeyError``."""
        found = load_preset(name)
        return Subject(name, found.scene, found.time, found.size)

    @staticmethod
    def of_scene(scene: Scene) -> "Subject":
        """Return the preset with this scene, or a custom subject at time 0."""
        for name in preset_names():
            if load_preset(name).scene == scene:
                return Subject.of_preset(name)
        return Subject(None, scene, 0.0, (1280, 720))


@dataclass(frozen=True)
class Settings:
    """Settings of a sweep. Width and height: of the compared pictures."""

    width: int = 160
    height: int = 90
    samples_along: int = 16
    """Samples along each side of a pixel of the float64 picture."""
    rounds: int = 7
    """At least 2."""


@dataclass(frozen=True)
class Rig:
    """The renderer. ``info``: vendor, renderer and version of the GL; ``threads``: maximum of a software GL."""

    measure: Measure
    info: Mapping[str, str]
    threads: int

    @property
    def machine(self) -> Machine:
        """The machine, as recorded in sweeps."""
        return Machine(
            vendor=self.info["vendor"],
            renderer=self.info["renderer"],
            version=self.info["version"],
            processor=_processor(),
            cores=os.cpu_count() or 1,
            threads=self.threads,
        )


@dataclass(frozen=True)
class Watcher:
    """Receives the progress of a sweep, and can stop it."""

    progress: Callable[[str, float, float | None], None] = lambda stage, share, remaining: None
    """Receives the stage in words, the fraction done, and the remaining seconds if known."""
    stopped: Callable[[], bool] = lambda: False


def truth_info(subject: Subject, settings: Settings) -> TruthInfo:
    """The float64 picture of a subject, and its path in the API."""
    return TruthInfo(
        url=None if subject.preset is None else f"/api/accuracy/{subject.preset}/truth.npy",
        width=settings.width,
        height=settings.height,
        time=subject.time,
        samples=settings.samples_along**2,
    )


def find_sweep(store: Store, subject: Subject, settings: Settings, machine: Machine) -> Sweep | None:
    """Return a stored sweep with the same plans, time, size, machine and versions, if there is one."""
    content = store.get("sweeps", _name(subject, settings, machine))
    if content is None:
        return None
    try:
        found = Sweep.model_validate_json(content)
    except ValueError:
        return None
    # A preset and a posted scene that equals it share their measurements.
    return found.model_copy(update={"preset": subject.preset, "truth": truth_info(subject, settings)})


def make_sweep(
    store: Store, subject: Subject, settings: Settings, rig: Rig, watcher: Watcher | None = None, *, again: bool = False
) -> Sweep:
    """Measure a scene, or find the measurement; ``again``: measure all the same.

    Raises :class:`seafoam.planner.PlanError`, what drawing raises, and :class:`StoppedError` where it was called off.
    """
    watcher = watcher or Watcher()
    machine = rig.machine
    if not again and (found := find_sweep(store, subject, settings, machine)) is not None:
        return found
    truth = make_truth(
        store,
        subject.scene,
        subject.time,
        settings.width,
        settings.height,
        settings.samples_along,
        progress=lambda share, remaining: watcher.progress("float64 truth", 0.3 * share, None),
        stopped=watcher.stopped,
    )
    sweep = _Sweeping(subject, settings, rig, watcher).run(truth.astype(np.float64))
    store.put("sweeps", _name(subject, settings, machine), sweep.model_dump_json().encode())
    return sweep


class _Sweeping:
    """One run through all points."""

    def __init__(self, subject: Subject, settings: Settings, rig: Rig, watcher: Watcher) -> None:
        self.subject = subject
        self.settings = settings
        self.rig = rig
        self.watcher = watcher
        self.points = points_of(subject.scene)
        self.drawn: dict[str, Picture] = {}
        """Pictures at the subject's own time, by plan."""
        self.ideals = self._ideals()
        everyone = [point.quality for point in self.points]
        extra = {plan: quality for wanted in self.ideals.values() for plan, quality in wanted.values()}
        compiled = everyone + [extra[plan] for plan in extra.keys() - {point.plan for point in self.points}]
        self.work = sum(COMPILE_WEIGHT + quality.samples for quality in compiled)
        self.work += 2.0 * settings.rounds * sum(1.0 + quality.samples for quality in everyone)
        self.done = 0.0
        self.began = clock.perf_counter()

    def run(self, truth: Picture) -> Sweep:
        settings, points = self.settings, self.points
        for point in points:
            self._picture(point.plan, point.quality, "compiling")
        timed, small = self._sizes()
        # Compiles what only finished pictures need.
        for point in points:
            self._draw(point.quality, 0, (Draw(*small, "rgba8"),), "compiling", 0.0)
        frames: dict[str, list[Picture]] = {point.id: [] for point in points}
        models: dict[str, list[TimeModel]] = {point.id: [] for point in points}
        compared = (settings.width, settings.height)
        for index in range(settings.rounds):
            first = index % len(points)
            turned = [*points[first:], *points[:first]]
            for point in turned if index % 2 == 0 else reversed(turned):
                before = models[point.id][-1] if index > 0 else None
                long = before is not None and before.at(*timed) > LONG_MS
                slow = before is not None and before.at(*compared) - before.fixed_ms > SLOW_MS
                warm = () if timed == compared or long else (Draw(*timed, "rgba8"),)
                larger = () if slow else (*warm, Draw(*timed, "rgba8"))
                draws = (Draw(*compared, "linear", keep=True), *larger, Draw(*small, "rgba8"))
                weight = 2.0 * (1.0 + point.quality.samples)
                stage = f"round {index + 1} of {settings.rounds}"
                drawn = self._draw(point.quality, index, draws, stage, weight)
                assert drawn[0].pixels is not None
                frames[point.id].append(drawn[0].pixels)
                large = compared if slow else timed
                models[point.id].append(_model(1000.0 * drawn[-2].seconds, large, 1000.0 * drawn[-1].seconds, small))
        measured = []
        errors = {point.id: metrics.errors(frames[point.id], truth) for point in points}
        times = {id: [model.at(*self.subject.size) for model in found] for id, found in models.items()}
        spreads = {id: _spread(values) for id, values in times.items()}
        best = front({id: (spread.median_ms, errors[id].rmse) for id, spread in spreads.items()})
        beaten = beating({id: (values, errors[id].rmse) for id, values in times.items()})
        for point in points:
            measured.append(
                MeasuredPoint(
                    **dict(point),
                    on_front=point.id in best,
                    beaten_by=beaten[point.id],
                    time=spreads[point.id],
                    model=_middle(models[point.id], self.subject.size),
                    error=errors[point.id],
                    causes=self._causes(point, errors[point.id].rmse, truth),
                )
            )
        return Sweep(
            preset=self.subject.preset,
            scene_sha256=scene_sha256(self.subject.scene),
            width=settings.width,
            height=settings.height,
            time=self.subject.time,
            truth=truth_info(self.subject, settings),
            timing=Timing(
                timer="wall",
                width=timed[0],
                height=timed[1],
                small_width=small[0],
                small_height=small[1],
                own_width=self.subject.size[0],
                own_height=self.subject.size[1],
                rounds=settings.rounds,
            ),
            machine=self.rig.machine,
            versions={name: version(name) for name in ("seafoam", "moderngl", "numpy", "flip-evaluator")},
            measured_at=datetime.now(UTC).isoformat(timespec="seconds"),
            seconds=round(clock.perf_counter() - self.began, 1),
            points=tuple(measured),
            front=best,
            steps=self._steps(times, {id: error.rmse for id, error in errors.items()}),
            sentences=sentences([point for id in best for point in measured if point.id == id], times),
        )

    def _ideals(self) -> dict[str, dict[str, tuple[str, Quality]]]:
        """By tier and cause ("rest": all three): the plan and the quality without that cause."""
        found: dict[str, dict[str, tuple[str, Quality]]] = {}
        for point in (one for one in self.points if one.tier is not None):
            whole = point.quality
            for cause in get_args(Cause):
                one = idealised(point.quality, cause)
                found.setdefault(point.id, {})[cause] = plan_sha256(self.subject.scene, one), one
                whole = idealised(whole, cause)
            found[point.id]["rest"] = plan_sha256(self.subject.scene, whole), whole
        return found

    def _causes(self, point: Point, error: float, truth: Picture) -> Causes | None:
        if point.tier is None:
            return None
        without = {
            cause: metrics.rmse(self._picture(plan, quality, "causes of error"), truth)
            for cause, (plan, quality) in self.ideals[point.id].items()
        }
        falls = {cause: error - without[cause] for cause in get_args(Cause)}
        return Causes(**falls, rest=without["rest"])

    def _picture(self, plan: str, quality: Quality, stage: str) -> Picture:
        """Return the linear picture at the subject's own time; each plan is drawn once."""
        if plan not in self.drawn:
            draw = Draw(self.settings.width, self.settings.height, "linear", keep=True)
            (drawn,) = self._draw(quality, 0, (draw,), stage, COMPILE_WEIGHT + quality.samples)
            assert drawn.pixels is not None
            self.drawn[plan] = drawn.pixels
        return self.drawn[plan]

    def _draw(
        self, quality: Quality, frame: int, draws: tuple[Draw, ...], stage: str, weight: float
    ) -> tuple[Drawn, ...]:
        if self.watcher.stopped():
            raise StoppedError
        scene = self.subject.scene
        at = self.subject.time + frame * FRAME_SECONDS
        drawn = self.rig.measure(MeasureJob(scene, quality, at, scene.camera, draws))
        self.done += weight
        share = min(self.done / self.work, 1.0)
        remaining = (clock.perf_counter() - self.began) * (1.0 / share - 1.0) if share > 0.02 else None
        self.watcher.progress(stage, 0.3 + 0.7 * share, remaining)
        return drawn

    def _sizes(self) -> tuple[tuple[int, int], tuple[int, int]]:
        """Return the timing size, at least that of the pictures, at most the subject's own; and the small size."""
        width, height = self.settings.width, self.settings.height
        whole = self.subject.size
        standard = next(point for point in self.points if point.id == "standard")
        while 2 * width <= whole[0] and 2 * height <= whole[1]:
            if LEAST_SHARE * width >= whole[0] and LEAST_SHARE * height >= whole[1]:
                drawn = self._draw(standard.quality, 0, 3 * (Draw(width, height, "rgba8"),), "timing size", 0.0)
                if min(one.seconds for one in drawn[1:]) >= ENOUGH_SECONDS:
                    break
            width, height = 2 * width, 2 * height
        return (width, height), (max(1, width // SMALL), max(1, height // SMALL))

    def _steps(self, rounds: Mapping[str, list[float]], error: Mapping[str, float]) -> tuple[Step, ...]:
        steps = []
        for owner, before, after, first, second in chains(self.subject.scene, self.points):
            compared = compare(rounds[first], rounds[second], error[first], error[second])
            worth = compared.measurable and compared.added_ms > 0.0
            steps.append(
                Step(
                    owner=owner,
                    pointer=after.pointer,
                    title=after.title,
                    cause=after.cause,
                    value_from=before.value,
                    value_to=after.value,
                    point_from=first,
                    point_to=second,
                    added_ms=compared.added_ms,
                    time_factor=compared.factor,
                    time_measurable=compared.measurable,
                    error_removed=error[first] - error[second],
                    error_factor=compared.error_factor,
                    error_per_ms=(error[first] - error[second]) / compared.added_ms if worth else None,
                    sentence=f"{after.title} {shown(before.value)} → {shown(after.value)}: {compared.words}",
                )
            )
        return tuple(steps)


def _spread(values: list[float]) -> TimeSpread:
    low, middle, high = quantiles(values, n=4, method="inclusive")
    return TimeSpread(median_ms=middle, low_ms=low, high_ms=high, rounds_ms=tuple(round(value, 4) for value in values))


def _model(large_ms: float, large: tuple[int, int], small_ms: float, small: tuple[int, int]) -> TimeModel:
    pixels, few = large[0] * large[1], small[0] * small[1]
    if pixels == few:
        return TimeModel(fixed_ms=0.0, ns_per_pixel=1e6 * large_ms / pixels)
    slope = max(0.0, (large_ms - small_ms) / (pixels - few))
    return TimeModel(fixed_ms=max(0.0, large_ms - slope * pixels), ns_per_pixel=1e6 * slope)


def _middle(models: list[TimeModel], size: tuple[int, int]) -> TimeModel:
    """Return the median of the constant parts, and of the rest of the median time."""
    fixed = median(model.fixed_ms for model in models)
    left = max(0.0, median(model.at(*size) for model in models) - fixed)
    return TimeModel(fixed_ms=fixed, ns_per_pixel=1e6 * left / (size[0] * size[1]))


def _name(subject: Subject, settings: Settings, machine: Machine) -> str:
    plans = sorted(point.plan for point in points_of(subject.scene))
    what = [FORMAT, plans, scene_sha256(subject.scene), subject.time, subject.size]
    how = [settings.width, settings.height, settings.samples_along, settings.rounds]
    versions = [version("seafoam"), version("moderngl"), np.__version__]
    return key_of(what, how, machine.model_dump(), versions) + ".json"


def _processor() -> str:
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
    except OSError:
        lines = []
    found = (line.partition(":")[2].strip() for line in lines if line.startswith("model name"))
    return next(found, platform.processor() or platform.machine())
