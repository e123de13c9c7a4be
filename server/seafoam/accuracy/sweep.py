"""A sweep: every point of a scene is drawn in turn, in several rounds, timed, and compared with the float64 picture.

Every round visits all points, so that a slowdown of the machine affects all of them. Frames of a round are 1/60 s later
than those of the round before, so the rounds are also the sequence in which popping is counted. A frame is drawn once
untimed before it is timed, except if it takes so long that a warm cache makes no difference.
"""

import os
import time as clock
from collections.abc import Mapping
from dataclasses import dataclass
from datetime import UTC, datetime
from importlib.metadata import version
from typing import get_args

import numpy as np

from seafoam.accuracy import metrics, model
from seafoam.accuracy.cache import key_of
from seafoam.accuracy.metrics import Picture
from seafoam.accuracy.points import chains, idealised, points_of, shown
from seafoam.accuracy.timing import beating, compare, front, median_model, sentences, spread_of, time_model
from seafoam.accuracy.truth import Measure, SweepStoppedError, TruthSpec, Watcher, make_truth
from seafoam.effects.effect import Cause
from seafoam.quality import Quality
from seafoam.reference import scene_sha256
from seafoam.render.service.frame_cache import DiskCache
from seafoam.render.service.jobs import Draw, Drawn, MeasureJob, Timer, plan_hash
from seafoam.scene import Scene, load_preset, preset_names

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

Size = tuple[int, int]
"""Width and height, pixels."""


@dataclass(frozen=True)
class Subject:
    """The scene to measure. ``size``: frame size for which times are reported, pixels."""

    preset: str | None
    scene: Scene
    time: float
    size: Size

    def truth(self, settings: "SweepSettings") -> TruthSpec:
        """Return the float64 picture with which its frames are compared."""
        return TruthSpec(self.scene, self.time, settings.width, settings.height, settings.samples_along)

    @staticmethod
    def of_preset(name: str) -> "Subject":
        """Return the subject of a preset. Raises ``KeyError``."""
        preset = load_preset(name)
        return Subject(name, preset.scene, preset.time, preset.size)

    @staticmethod
    def of_scene(scene: Scene) -> "Subject":
        """Return the preset with this scene, or a custom subject at time 0."""
        for name in preset_names():
            if load_preset(name).scene == scene:
                return Subject.of_preset(name)
        return Subject(None, scene, 0.0, (1280, 720))


@dataclass(frozen=True)
class SweepSettings:
    """Settings of a sweep. Width and height: of the compared pictures."""

    width: int = 160
    height: int = 90
    samples_along: int = 16
    """Samples along each side of a pixel of the float64 picture."""
    rounds: int = 7
    """At least 2."""
    timer: Timer = "wall"


@dataclass(frozen=True)
class Rig:
    """The renderer. ``info``: vendor, renderer and version of the GL; ``threads``: maximum of a software GL."""

    measure: Measure
    info: Mapping[str, str]
    threads: int

    @property
    def machine(self) -> model.Machine:
        return model.Machine(**self.info, processor=model.processor(), cores=os.cpu_count() or 1, threads=self.threads)


def truth_info(subject: Subject, settings: SweepSettings) -> model.TruthInfo:
    """The float64 picture of a subject, and its path in the API."""
    return model.TruthInfo(
        url=None if subject.preset is None else f"/api/accuracy/{subject.preset}/truth.npy",
        width=settings.width,
        height=settings.height,
        time=subject.time,
        samples=settings.samples_along**2,
    )


def find_sweep(
    store: DiskCache, subject: Subject, settings: SweepSettings, machine: model.Machine
) -> model.Sweep | None:
    """Return a stored sweep with the same plans, time, size, machine and versions, if there is one."""
    content = store.get(_name(subject, settings, machine))
    try:
        sweep = model.Sweep.model_validate_json(content or b"")
    except ValueError:
        return None
    # A preset and a posted scene that equals it share their measurements.
    return sweep.model_copy(update={"preset": subject.preset, "truth": truth_info(subject, settings)})


def make_sweep(
    store: DiskCache,
    subject: Subject,
    settings: SweepSettings,
    rig: Rig,
    watcher: Watcher | None = None,
    *,
    again: bool = False,
) -> model.Sweep:
    """Measure a scene, or return the stored measurement; ``again``: ignore a stored one.

    Raises :class:`seafoam.planner.PlanError`, what drawing raises, and :class:`SweepStoppedError` if the watcher stops
    it.
    """
    watcher = watcher or Watcher()
    machine = rig.machine
    if not again and (found := find_sweep(store, subject, settings, machine)) is not None:
        return found
    first = Watcher(lambda stage, share, _: watcher.progress(stage, 0.3 * share, None), watcher.stopped)
    truth = make_truth(store, subject.truth(settings), rig.measure, first)
    sweep = _Sweeping(subject, settings, rig, watcher).run(truth.astype(np.float64))
    store.put(_name(subject, settings, machine), sweep.model_dump_json().encode())
    return sweep


class _Sweeping:
    def __init__(self, subject: Subject, settings: SweepSettings, rig: Rig, watcher: Watcher) -> None:
        self.subject = subject
        self.settings = settings
        self.rig = rig
        self.watcher = watcher
        self.points = points_of(subject.scene)
        self.drawn: dict[str, Picture] = {}
        """Pictures at the subject's own time, by plan."""
        self.ideals = {point.id: _ideals(point.quality) for point in self.points if point.tier is not None}
        drawn = [quality for ideals in self.ideals.values() for quality in ideals.values()]
        plans = {plan_hash(subject.scene, quality) for quality in drawn} | {point.plan for point in self.points}
        self.work = len(plans) + (1 + settings.rounds) * len(self.points)
        """Measurements, for the progress: without those that find the size."""
        self.done = 0
        self.began = clock.perf_counter()

    def run(self, truth: Picture) -> model.Sweep:
        timed, small = self._compile()
        frames, models = self._rounds(timed, small)
        curve = metrics.tone_curve(self.subject.scene)
        errors = {point.id: metrics.errors(frames[point.id], truth, curve) for point in self.points}
        rmse = {id: error.rmse for id, error in errors.items()}
        times = {id: [fit.at(*self.subject.size) for fit in rounds] for id, rounds in models.items()}
        spreads = {id: spread_of(values) for id, values in times.items()}
        best = front({id: (spread.median_ms, rmse[id]) for id, spread in spreads.items()})
        beaten = beating({id: (values, rmse[id]) for id, values in times.items()})
        measured = {
            point.id: model.MeasuredPoint(
                **dict(point),
                on_front=point.id in best,
                beaten_by=beaten[point.id],
                time=spreads[point.id],
                model=median_model(models[point.id], self.subject.size),
                error=errors[point.id],
                causes=self._causes(point, rmse[point.id], truth),
            )
            for point in self.points
        }
        return model.Sweep(
            preset=self.subject.preset,
            scene_sha256=scene_sha256(self.subject.scene),
            width=self.settings.width,
            height=self.settings.height,
            time=self.subject.time,
            truth=truth_info(self.subject, self.settings),
            timing=model.Timing(
                timer=self.settings.timer,
                width=timed[0],
                height=timed[1],
                small_width=small[0],
                small_height=small[1],
                own_width=self.subject.size[0],
                own_height=self.subject.size[1],
                rounds=self.settings.rounds,
            ),
            machine=self.rig.machine,
            versions={name: version(name) for name in ("seafoam", "moderngl", "numpy", "flip-evaluator")},
            measured_at=datetime.now(UTC).isoformat(timespec="seconds"),
            seconds=round(clock.perf_counter() - self.began, 1),
            points=tuple(measured.values()),
            front=best,
            steps=self._steps(times, rmse),
            sentences=sentences([measured[id] for id in best], times),
        )

    def _compile(self) -> tuple[Size, Size]:
        """Compile every point's programs, and return the timing size and the small size."""
        for point in self.points:
            self._picture(point.quality, "compiling")
        timed, small = self._sizes()
        # Display-referred frames have a pass that linear ones lack.
        for point in self.points:
            self._draw(point.quality, 0, (Draw(*small, "rgba8"),), "compiling")
        return timed, small

    def _rounds(self, timed: Size, small: Size) -> tuple[dict[str, list[Picture]], dict[str, list[model.TimeModel]]]:
        """Pictures and time models of every point, one per round."""
        points, rounds = self.points, self.settings.rounds
        frames: dict[str, list[Picture]] = {point.id: [] for point in points}
        models: dict[str, list[model.TimeModel]] = {point.id: [] for point in points}
        for index in range(rounds):
            first = index % len(points)
            turned = [*points[first:], *points[:first]]
            for point in turned if index % 2 == 0 else reversed(turned):
                last = models[point.id][-1] if index > 0 else None
                stage = f"round {index + 1} of {rounds}"
                picture, fit = self._measure(point.quality, index, last, timed, small, stage)
                frames[point.id].append(picture)
                models[point.id].append(fit)
        return frames, models

    def _measure(
        self, quality: Quality, frame: int, last: model.TimeModel | None, timed: Size, small: Size, stage: str
    ) -> tuple[Picture, model.TimeModel]:
        """A frame's linear picture and its time model. ``last``: the model of the round before."""
        compared = (self.settings.width, self.settings.height)
        long = last is not None and last.at(*timed) > LONG_MS
        slow = last is not None and last.at(*compared) - last.fixed_ms > SLOW_MS
        warm = () if timed == compared or long else (Draw(*timed, "rgba8"),)
        larger = () if slow else (*warm, Draw(*timed, "rgba8"))
        # The first compiles, and draws what is kept, where other points have taken the place of it.
        draws = (Draw(*small, "rgba8"), Draw(*compared, "linear", keep=True), *larger, Draw(*small, "rgba8"))
        drawn = self._draw(quality, frame, draws, stage)
        pixels = drawn[1].pixels
        assert pixels is not None
        large = compared if slow else timed
        return pixels, time_model(1000.0 * drawn[-2].seconds, large, 1000.0 * drawn[-1].seconds, small)

    def _causes(self, point: model.Point, error: float, truth: Picture) -> model.Causes | None:
        if point.tier is None:
            return None
        ideals = self.ideals[point.id].items()
        left = {cause: metrics.rmse(self._picture(quality, "causes of error"), truth) for cause, quality in ideals}
        return model.Causes(rest=left.pop("rest"), **{cause: error - without for cause, without in left.items()})

    def _picture(self, quality: Quality, stage: str) -> Picture:
        plan = plan_hash(self.subject.scene, quality)
        if plan not in self.drawn:
            draw = Draw(self.settings.width, self.settings.height, "linear", keep=True)
            (drawn,) = self._draw(quality, 0, (draw,), stage)
            assert drawn.pixels is not None
            self.drawn[plan] = drawn.pixels
        return self.drawn[plan]

    def _draw(self, quality: Quality, frame: int, draws: tuple[Draw, ...], stage: str) -> tuple[Drawn, ...]:
        if self.watcher.stopped():
            raise SweepStoppedError
        scene = self.subject.scene
        at = self.subject.time + frame * FRAME_SECONDS
        drawn = self.rig.measure(MeasureJob(scene, quality, at, scene.camera, draws, self.settings.timer))
        self.done += 1
        share = min(self.done / self.work, 1.0)
        remaining = (clock.perf_counter() - self.began) * (1.0 / share - 1.0) if share > 0.02 else None
        self.watcher.progress(stage, 0.3 + 0.7 * share, remaining)
        return drawn

    def _sizes(self) -> tuple[Size, Size]:
        """Return the timing size, at least that of the pictures, at most the subject's own; and the small size."""
        width, height = self.settings.width, self.settings.height
        whole = self.subject.size
        standard = next(point for point in self.points if point.id == "standard")
        while 2 * width <= whole[0] and 2 * height <= whole[1]:
            if LEAST_SHARE * width >= whole[0] and LEAST_SHARE * height >= whole[1]:
                drawn = self._draw(standard.quality, 0, 3 * (Draw(width, height, "rgba8"),), "timing size")
                if min(frame.seconds for frame in drawn[1:]) >= ENOUGH_SECONDS:
                    break
            width, height = 2 * width, 2 * height
        return (width, height), (max(1, width // SMALL), max(1, height // SMALL))

    def _steps(self, rounds: Mapping[str, list[float]], error: Mapping[str, float]) -> tuple[model.Step, ...]:
        steps = []
        for before, after, first, second in chains(self.subject.scene, self.points):
            compared = compare(rounds[first], rounds[second], error[first], error[second])
            removed, worth = error[first] - error[second], compared.measurable and compared.added_ms > 0.0
            steps.append(
                model.Step(
                    **after.model_dump(exclude={"value"}),
                    value_from=before.value,
                    value_to=after.value,
                    error_per_ms=removed / compared.added_ms if worth else None,
                    sentence=f"{after.title} {shown(before.value)} → {shown(after.value)}: {compared.words}",
                )
            )
        return tuple(steps)


def _ideals(quality: Quality) -> dict[str, Quality]:
    """By cause of error ("rest": all three): the quality without that cause."""
    rest = quality
    for cause in get_args(Cause):
        rest = idealised(rest, cause)
    return {cause: idealised(quality, cause) for cause in get_args(Cause)} | {"rest": rest}


def _name(subject: Subject, settings: SweepSettings, machine: model.Machine) -> str:
    plans = sorted(point.plan for point in points_of(subject.scene))
    what = [model.FORMAT, plans, scene_sha256(subject.scene), subject.time, subject.size]
    how = [settings.width, settings.height, settings.samples_along, settings.rounds, settings.timer]
    versions = [version("seafoam"), version("moderngl"), np.__version__]
    return key_of(what, how, machine.model_dump(), versions) + ".json"
