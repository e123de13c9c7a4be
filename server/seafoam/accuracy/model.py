"""Data model of a measured sweep: served by the API, stored in the cache and shown in reports."""

import platform
from pathlib import Path
from typing import Literal

from pydantic import Field

from seafoam.described import Described
from seafoam.effects.effect import Cause
from seafoam.quality import Quality, Tier

FORMAT = 5
"""Version of the JSON format; part of the cache keys."""

ParameterValue = bool | int | float | str


class SweepPart(Described, extra="forbid", frozen=True, allow_inf_nan=False):
    """Base class of this module's models."""


class SettingPart(SweepPart):
    """Base class of what is said of one quality setting."""

    owner: str = Field(description="Effect that declares the setting, or 'frame'")
    pointer: str = Field(description="JSON pointer into the quality")
    title: str
    cause: Cause = Field(description="Kind of error that the setting affects")


class ParameterInfo(SettingPart):
    """A quality setting and its measured values."""

    steps: tuple[ParameterValue, ...] = Field(description="Measured values, fastest first")


class ParameterChoice(SettingPart):
    """A value of one setting; all others are as in tier standard."""

    value: ParameterValue


class Point(SweepPart):
    """A measured quality: a tier, or tier standard with one setting changed."""

    id: str = Field(examples=["standard", "samples=4"])
    """Name of the tier, or the changed setting and its value"""
    label: str
    tier: Tier | None
    parameter: ParameterChoice | None
    quality: Quality
    plan: str = Field(description="SHA-256 of the frame plan")


class TruthInfo(SweepPart):
    """The converged float64 picture against which errors are measured."""

    url: str | None = Field(description="float32 (height, width, 4): linear RGB and foam coverage; top row first")
    width: int
    height: int
    time: float = Field(description="Time of the scene, s")
    samples: int = Field(description="Samples per pixel")


class SweepPoints(SweepPart):
    """The points of a sweep, before it is measured."""

    preset: str
    truth: TruthInfo
    points: tuple[Point, ...]


class TimeSpread(SweepPart):
    """Time of a frame at the subject's own size, from the first call until it is finished, without readback.

    Predicted by a line through the times of two frame sizes in each round.
    """

    median_ms: float
    low_ms: float = Field(description="First quartile")
    high_ms: float = Field(description="Third quartile")
    rounds_ms: tuple[float, ...] = Field(description="Times of the single rounds; one round renders all points in turn")


class TimeModel(SweepPart):
    """time = fixed_ms + ns_per_pixel · width · height / 10⁶, from frames of two sizes."""

    fixed_ms: float
    ns_per_pixel: float

    def at(self, width: int, height: int) -> float:
        """Return the predicted time, ms."""
        return self.fixed_ms + 1e-6 * self.ns_per_pixel * width * height


class Errors(SweepPart):
    """Errors against the float64 picture."""

    rmse: float
    """Root mean square error of linear RGB, clipped at display white, in levels (white = 255)"""
    max: float = Field(description="Maximum error of any channel, in the same levels")
    flip: float = Field(description="Mean FLIP of the tone-mapped sRGB pictures, 0 to 1")
    coverage: float = Field(description="RMSE of foam coverage, 0 to 1")
    flipped: float
    """Fraction of pixels that have foam (coverage above 0.5) in only one of the two pictures"""
    popping: float | None
    """Popping: fraction of the existing foam that disappears within 1/60 s, in the worst pair of frames; null without
    foam. Compare with tier reference: some foam of the sea disappears in truth"""


class Causes(SweepPart):
    """Reduction of the RMSE, in levels, when only the settings of one cause are as in tier reference.

    Negative: the error grows, because that cause masked another. ``rest``: error that remains when all three are.
    """

    geometry: float
    filtering: float
    precision: float
    rest: float


class MeasuredPoint(Point):
    """A quality with its time and its error."""

    on_front: bool = Field(description="True if no measured point is both faster and more exact")
    beaten_by: tuple[str, ...]
    """Points with no greater error that are faster by at least a tenth in three quarters of the rounds; the most exact
    first"""
    time: TimeSpread
    model: TimeModel
    error: Errors
    causes: Causes | None = Field(description="Error by cause, for tiers; null where a single setting is changed")


class Step(SettingPart):
    """Step from one value of a setting to the next more exact one, all other settings as in tier standard."""

    value_from: ParameterValue
    value_to: ParameterValue
    error_per_ms: float | None
    """Reduction of the RMSE, levels, over the median of the added times; null where that is not measurable"""
    sentence: str


class Timing(SweepPart):
    """Conditions of the timing."""

    timer: Literal["wall", "processor", "gpu"]
    """wall: wall clock around a frame until it is finished; processor: processor time of the process meanwhile; gpu:
    GPU timer queries"""
    width: int
    """Size of the larger timed frames, pixels; slow points are timed at the size of the compared pictures"""
    height: int
    small_width: int = Field(description="Size of the smaller timed frames, for the constant part of the time model")
    small_height: int
    own_width: int = Field(description="Frame size for which times are reported: the preset's own")
    own_height: int
    rounds: int


def processor() -> str:
    """Return the name of this machine's processor."""
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
    except OSError:
        lines = []
    names = (line.partition(":")[2].strip() for line in lines if line.startswith("model name"))
    return next(names, platform.processor() or platform.machine())


class Machine(SweepPart):
    """The machine on which times were measured."""

    vendor: str
    renderer: str
    version: str
    processor: str
    cores: int
    threads: int = Field(description="Number of threads of a software renderer")


class Sweep(SweepPart):
    """The measured cost of accuracy of a scene."""

    format: int = FORMAT
    status: Literal["measured"] = "measured"
    preset: str | None = Field(description="Name of the preset; null: a custom scene")
    scene_sha256: str
    width: int = Field(description="Size of the compared pictures, pixels")
    height: int
    time: float = Field(description="Time of the scene, s")
    truth: TruthInfo
    timing: Timing
    machine: Machine
    versions: dict[str, str]
    measured_at: str = Field(description="Date and time of the measurement, ISO 8601, UTC")
    seconds: float = Field(description="Duration of the sweep without the float64 reference, s")
    points: tuple[MeasuredPoint, ...]
    front: tuple[str, ...]
    """Pareto front: IDs of points that no other point beats in both time and RMSE, fastest first"""
    steps: tuple[Step, ...]
    sentences: tuple[str, ...] = Field(description="Summary of the front in words")

    def point(self, id: str) -> MeasuredPoint:
        """A point by its id. Raises ``KeyError``."""
        return {point.id: point for point in self.points}[id]


class Running(SweepPart):
    """A measurement in progress."""

    status: Literal["queued", "running"]
    stage: str = Field(description="Current stage")
    progress: float = Field(description="Progress, 0 to 1")
    eta_s: float | None = Field(default=None, description="Estimated remaining time, s")
