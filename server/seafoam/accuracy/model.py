"""A measured sweep as data: what the API serves, the cache keeps and the reports show."""

from typing import Literal

from pydantic import BaseModel, ConfigDict, Field

from seafoam.effects.effect import Cause
from seafoam.quality import Quality, Tier

FORMAT = 4
"""Of the JSON; part of the cache's keys."""

KnobValue = bool | int | float | str


class Part(BaseModel):
    """Base of everything here."""

    model_config = ConfigDict(extra="forbid", frozen=True, allow_inf_nan=False)


class KnobInfo(Part):
    """A knob: what it is and which values of it are measured."""

    owner: str = Field(description="The effect that declares it, or 'frame'")
    pointer: str = Field(description="JSON pointer into the quality")
    title: str
    cause: Cause = Field(description="The kind of error that it works on")
    steps: tuple[KnobValue, ...] = Field(description="Values that are measured, from cheap to exact")


class KnobChoice(Part):
    """A value of one knob; all others are as in tier standard."""

    owner: str
    pointer: str
    title: str
    cause: Cause
    value: KnobValue


class Point(Part):
    """A quality that is measured: a tier, or standard with one knob changed."""

    id: str = Field(description="Name of the tier, or the knob and its value", examples=["standard", "samples=4"])
    label: str
    tier: Tier | None
    knob: KnobChoice | None
    quality: Quality
    plan: str = Field(description="SHA-256 of its plan")


class TruthInfo(Part):
    """The converged float64 picture that errors are against."""

    url: str | None = Field(description="float32 (height, width, 4): linear RGB, foam coverage; rows from the top")
    width: int
    height: int
    time: float = Field(description="Time of the scene, s")
    samples: int = Field(description="Samples a pixel")


class Points(Part):
    """What is measured, before it is."""

    preset: str
    truth: TruthInfo
    points: tuple[Point, ...]


class TimeSpread(Part):
    """What a frame of the subject's own size takes, from the first call until it is finished, reading it back left out.

    Told from frames of two sizes in each round, by the line through them.
    """

    median_ms: float
    low_ms: float = Field(description="First quartile")
    high_ms: float = Field(description="Third quartile")
    rounds_ms: tuple[float, ...] = Field(description="Every round; rounds of different points were drawn together")


class TimeModel(Part):
    """time = fixed_ms + ns_per_pixel · width · height / 10⁶, from frames of two sizes."""

    fixed_ms: float
    ns_per_pixel: float

    def at(self, width: int, height: int) -> float:
        """Predicted milliseconds."""
        return self.fixed_ms + 1e-6 * self.ns_per_pixel * width * height


class Errors(Part):
    """Against the truth."""

    rmse: float = Field(description="Of linear RGB clipped at display white, in levels: white = 255")
    max: float = Field(description="Greatest difference of a channel, the same levels")
    flip: float = Field(description="Mean FLIP of the tone-mapped sRGB pictures, 0 to 1")
    coverage: float = Field(description="RMSE of foam coverage, 0 to 1")
    flipped: float = Field(description="Share of pixels that have foam (coverage over 0.5) in one picture alone")
    popping: float | None = Field(
        description="Share of living foam that is lost from one frame to the next, 1/60 s later, in the worst pair of "
        "the rounds; null without foam. The sea loses some itself: compare with the tier reference"
    )


class Causes(Part):
    """By how many levels of RMSE the error falls when the knobs of one cause alone are as in tier reference.

    Negative: it grows, since that cause hid another. ``rest``: what remains when all three are.
    """

    geometry: float
    filtering: float
    precision: float
    rest: float


class MeasuredPoint(Point):
    """A quality with its time and its error."""

    on_front: bool = Field(description="Nothing measured is both faster and more exact")
    beaten_by: tuple[str, ...] = Field(
        description="Points that are at most as far from the truth, and faster by a tenth and more in three quarters "
        "of the rounds; the most exact first"
    )
    time: TimeSpread
    model: TimeModel
    error: Errors
    causes: Causes | None = Field(description="Of tiers; null where one knob alone is changed")


class Step(Part):
    """From one value of a knob to the next more exact one, all other knobs as in tier standard."""

    owner: str
    pointer: str
    title: str
    cause: Cause
    value_from: KnobValue
    value_to: KnobValue
    point_from: str
    point_to: str
    added_ms: float = Field(description="Median of the differences by round")
    time_factor: float = Field(description="Median of the ratios by round")
    time_measurable: bool = Field(description="The quartiles of these ratios lie on one side of 1")
    error_removed: float = Field(description="RMSE, levels; negative: more error")
    error_factor: float = Field(description="RMSE before over RMSE after")
    error_per_ms: float | None = Field(description="error_removed / added_ms; null where that means nothing")
    sentence: str


class Timing(Part):
    """How times were taken."""

    timer: Literal["wall", "gpu"] = Field(description="wall: around a frame and its finish; gpu: timer queries")
    width: int = Field(
        description="Of the larger frames that are timed, pixels; slow points are timed by the compared pictures"
    )
    height: int
    small_width: int = Field(description="Of the smaller ones, for the fixed part of the model")
    small_height: int
    own_width: int = Field(description="Of the frames that times are told for: the subject's own")
    own_height: int
    rounds: int


class Machine(Part):
    """Where times were taken."""

    vendor: str
    renderer: str
    version: str
    processor: str
    cores: int
    threads: int = Field(description="Threads that a software renderer may use")


class Sweep(Part):
    """The measured cost of accuracy of a scene."""

    format: int = FORMAT
    status: Literal["measured"] = "measured"
    preset: str | None = Field(description="Null: a scene of its own")
    scene_sha256: str
    width: int = Field(description="Of the pictures that errors are taken from, pixels")
    height: int
    time: float = Field(description="Time of the scene, s")
    truth: TruthInfo
    timing: Timing
    machine: Machine
    versions: dict[str, str]
    measured_at: str = Field(description="ISO 8601, UTC")
    seconds: float = Field(description="How long the sweep took, truth not counted")
    points: tuple[MeasuredPoint, ...]
    front: tuple[str, ...] = Field(description="Points that nothing beats in both time and RMSE, from the fastest")
    steps: tuple[Step, ...]
    sentences: tuple[str, ...] = Field(description="What the front says in words")

    def point(self, id: str) -> MeasuredPoint:
        """A point by its id. Raises ``KeyError``."""
        for point in self.points:
            if point.id == id:
                return point
        raise KeyError(id)


class Running(Part):
    """A measurement that is not finished."""

    status: Literal["queued", "running"]
    stage: str = Field(description="What is being done")
    progress: float = Field(description="Share of the work that is done, 0 to 1")
    eta_s: float | None = Field(default=None, description="Seconds that remain, estimated")
