"""Query parameters and bodies, with the ranges declared by the scene. Nothing here imports the web framework."""

from typing import Annotated, Any, Literal, get_args

from pydantic import ConfigDict, Discriminator, Field, Tag, field_validator
from pydantic.fields import FieldInfo

from seafoam.api.http.problems import BadRequestError, FieldProblem
from seafoam.described import Described
from seafoam.numerals import numeral_fields
from seafoam.quality import TIERS, Quality, Tier
from seafoam.render.encode import FrameFormat, Precision
from seafoam.render.service.jobs import FrameJob
from seafoam.scene import Camera, Foam, Look, Preset, Scene

TIME_LIMIT = 1e9
"""Maximum |time|, s."""
DEFAULT_WIDTH, DEFAULT_HEIGHT = 1280, 720
MAX_SIDE = 16384
"""What a server may be set to draw at most, pixels; each has its own limit."""

TierOrAuto = Literal[Tier, "auto"]


class Parameters(Described):
    """Base class of query parameters; unknown ones are rejected. This class itself has none."""

    model_config = ConfigDict(extra="forbid", frozen=True, allow_inf_nan=False)
    _numerals = field_validator("*", mode="before")(numeral_fields)


def _same(info: FieldInfo, description: str = "", *, required: bool = False, **override: Any) -> Any:
    """Return a query parameter, optional unless required, with the range and description of a scene field."""
    bounds: dict[str, Any] = {}
    for rule in info.metadata:
        limits = {name: getattr(rule, name, None) for name in ("ge", "le", "max_length", "pattern")}
        bounds |= {name: value for name, value in limits.items() if value is not None}
    default = ... if required else None
    return Field(default=default, description=description or info.description, **(bounds | override))


def _axis(index: int, description: str, example: float, *, required: bool = False) -> Any:
    (info,) = (rule for rule in get_args(get_args(Camera.model_fields["position"].annotation)[index])[1:])
    return _same(info, description, required=required, examples=[example])


Time = Annotated[float, Field(ge=-TIME_LIMIT, le=TIME_LIMIT, description="Time, s", examples=[12.5])]
Budget = Annotated[
    float | None,
    Field(
        gt=0.0,
        le=1e6,
        description="With quality auto: maximum frame time, ms, without readback and encoding",
        examples=[8.0],
    ),
]
Dither = Annotated[
    bool,
    Field(description="Of png and webp: dither 8 bits from 16, against bands in skies; false: rounded, as in the page"),
]
ExrPrecision = Annotated[
    Precision, Field(description="Of exr: 16-bit or 32-bit floating-point numbers", examples=["float"])
]
OwnCamera = Annotated[Camera | None, Field(description="Camera; absent: the scene's")]
OriginalPreset = Annotated[
    str | None,
    Field(
        max_length=80,
        description="Name of the preset that the scene began from; it changes no pixel and is kept in the recipe",
        examples=["default"],
    ),
]


class SceneOverrides(Parameters):
    """Changes to a preset's scene."""

    look: Look | None = Field(default=None, description="Foam look; absent: the preset's", examples=["halftone"])
    mask: str | None = _same(
        Foam.model_fields["mask"],
        "Foam mask, one of /api/masks or family:sigma:size:seed[:aspect:age]; absent: the preset's",
        examples=["vac-6"],
    )

    def apply(self, scene: Scene) -> Scene:
        """Return the scene with these changes. Raises :class:`BadRequestError` if it has no foam to change."""
        if not self.changed:
            return scene
        if scene.foam is None:
            raise BadRequestError(
                *(FieldProblem(parameter=name, detail=f"{name}: this preset has no foam") for name in self.changed)
            )
        return scene.model_copy(update={"foam": scene.foam.model_copy(update=self.changed)})

    @property
    def changed(self) -> dict[str, str]:
        """The parameters that change the scene, by name."""
        return self.model_dump(include={"look", "mask"}, exclude_none=True)


class PlanParameters(SceneOverrides):
    """Parameters of a preset's frame plan."""

    quality: Tier = Field(default="standard", examples=["high"])
    """Quality tier; single settings require POST"""


FORMATS = "png, webp (lossless), exr (linear, OpenEXR), or npy (linear float32)"


class FrameParameters(SceneOverrides):
    """Parameters of a frame of a preset."""

    quality: TierOrAuto = Field(default="standard", examples=["high"])
    """Quality tier, or auto: the most exact quality predicted to render within budget_ms; single settings require
    POST"""
    budget_ms: Budget = None

    time: float | None = Field(default=None, ge=-TIME_LIMIT, le=TIME_LIMIT, examples=[12.5])
    """Time, s; absent: the preset's"""
    width: int | None = Field(default=None, ge=1, le=MAX_SIDE, examples=[640])
    """Width, pixels; absent: the preset's"""
    height: int | None = Field(default=None, ge=1, le=MAX_SIDE, examples=[360])
    """Height, pixels; absent: the preset's"""
    x: float | None = _axis(0, "Camera position along +x, m; absent: the preset's, as for all camera parameters", 0.0)
    y: float | None = _axis(1, "Camera height above still water, m", 4.5)
    z: float | None = _axis(2, "Camera position along +z, m", -20.0)
    yaw: float | None = _same(Camera.model_fields["yaw"], examples=[0.35])
    pitch: float | None = _same(Camera.model_fields["pitch"], examples=[-0.2])
    roll: float | None = _same(Camera.model_fields["roll"], examples=[0.0])
    fov: float | None = _same(Camera.model_fields["fov"], examples=[0.9])
    dither: Dither = True
    precision: ExrPrecision = "half"

    def camera(self, own: Camera) -> Camera:
        """Return the preset's camera with the given parameters replaced."""
        eye = zip((self.x, self.y, self.z), own.position, strict=True)
        x, y, z = (at if given is None else given for given, at in eye)
        angles = {name: value for name in ("yaw", "pitch", "roll", "fov") if (value := getattr(self, name)) is not None}
        return own.model_copy(update={"position": (x, y, z), **angles})

    def job(self, preset: Preset, format: FrameFormat) -> FrameJob:
        """Return a preset's frame with the given parameters; with quality auto that of tier standard.

        Raises as :meth:`apply` does.
        """
        scene = self.apply(preset.scene)
        quality = TIERS["standard" if self.quality == "auto" else self.quality]
        time = preset.time if self.time is None else self.time
        width = preset.size[0] if self.width is None else self.width
        height = preset.size[1] if self.height is None else self.height
        view = self.camera(scene.camera), width, height
        return FrameJob(scene, quality, time, *view, format, preset.name, self.dither, self.precision)


class ViewParameters(Parameters):
    """Size and camera of a frame, none of which has a default."""

    width: int = Field(ge=1, le=MAX_SIDE, description="Width, pixels", examples=[640])
    height: int = Field(ge=1, le=MAX_SIDE, description="Height, pixels", examples=[360])
    x: float = _axis(0, "Camera position along +x, m", 0.0, required=True)
    y: float = _axis(1, "Camera height above still water, m", 4.5, required=True)
    z: float = _axis(2, "Camera position along +z, m", -20.0, required=True)
    yaw: float = _same(Camera.model_fields["yaw"], required=True, examples=[0.35])
    pitch: float = _same(Camera.model_fields["pitch"], required=True, examples=[-0.2])
    roll: float = _same(Camera.model_fields["roll"], required=True, examples=[0.0])
    fov: float = _same(Camera.model_fields["fov"], required=True, examples=[0.9])

    @property
    def camera(self) -> Camera:
        angles = {name: getattr(self, name) for name in ("yaw", "pitch", "roll", "fov")}
        return Camera(position=(self.x, self.y, self.z), **angles)


class PlanFrameParameters(ViewParameters):
    """Parameters of a frame of a plan. All that the picture depends on is required, since its address is immutable."""

    dither: Dither = True
    precision: ExrPrecision = "half"


class StreamFrameParameters(ViewParameters):
    """Parameters of a frame of a stream."""

    time: Time


class ThumbnailParameters(Parameters):
    """Parameters of a preset's thumbnail."""

    width: int = Field(default=320, ge=16, le=640, examples=[320])
    """Width, pixels; the height follows from the preset's size"""


def _tier_or_quality(value: Any) -> Literal["tier", "parameters"]:
    return "tier" if isinstance(value, str) else "parameters"


TierOrQuality = Annotated[
    Annotated[Tier, Tag("tier")] | Annotated[Quality, Tag("parameters")], Discriminator(_tier_or_quality)
]


TierAutoOrQuality = Annotated[
    Annotated[TierOrAuto, Tag("tier")] | Annotated[Quality, Tag("parameters")], Discriminator(_tier_or_quality)
]


def quality_of(quality: Tier | Quality) -> Quality:
    """Return the settings of a tier; settings are returned as they are."""
    return quality if isinstance(quality, Quality) else TIERS[quality]


class PlanRequest(Described):
    """A scene and a quality to compile into a frame plan."""

    model_config = ConfigDict(extra="forbid", frozen=True, allow_inf_nan=False)

    scene: Scene = Field(examples=[{"waves": [{"model": "parametric"}], "foam": {}}])
    """The scene: waves, foam, water, light and camera"""
    quality: TierOrQuality = "standard"
    """A tier, or the settings that differ from tier standard"""


class ViewRequest(PlanRequest):
    """A scene as it is seen at a time from a camera, in a picture of a size."""

    time: Time = 0.0
    width: int = Field(default=DEFAULT_WIDTH, ge=1, le=MAX_SIDE, description="Width, pixels", examples=[640])
    height: int = Field(default=DEFAULT_HEIGHT, ge=1, le=MAX_SIDE, description="Height, pixels", examples=[360])
    camera: OwnCamera = None
    preset: OriginalPreset = None


class FrameRequest(ViewRequest):
    """A frame to render: scene, quality, time, size and camera."""

    quality: TierAutoOrQuality = "standard"  # type: ignore[assignment]
    """A tier, the settings that differ from tier standard, or auto: the most exact quality predicted to render within
    budget_ms"""
    budget_ms: Budget = None
    format: FrameFormat = Field(default="png", description=FORMATS)
    dither: Dither = True
    precision: ExrPrecision = "half"

    @property
    def job(self) -> FrameJob:
        """Return the frame; with quality auto that of tier standard."""
        quality = quality_of("standard" if self.quality == "auto" else self.quality)
        view = self.camera or self.scene.camera, self.width, self.height
        return FrameJob(self.scene, quality, self.time, *view, self.format, self.preset, self.dither, self.precision)
