"""A shore: sea floor and land over a square, and surf. docs/formulae.md, section 8."""

import base64
import binascii
import io
import math
from functools import lru_cache
from typing import Annotated, Literal

import numpy as np
from numpy.typing import NDArray
from PIL import Image
from pydantic import BaseModel, ConfigDict, Field, model_validator

from seafoam.scene.chance import chance

Floats = NDArray[np.float64]
_Place = Annotated[float, Field(ge=-1e7, le=1e7)]
_Share = Annotated[float, Field(ge=0.0, le=1.0)]
_Rgb = tuple[_Share, _Share, _Share]

STEPS = 1024
"""Heights are multiples of 1/1024 m, which hides differences in the last bits of square roots."""


class _Part(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True, allow_inf_nan=False)


class Surf(_Part):
    """Shore waves: skewed trochoids x = s − b sin(2π frac(s)^γ), y = a cos(2π frac(s)^γ) (Outerra 2011)."""

    height: float = Field(default=1.0, ge=0.0, le=6.0, description="Height of the breakers, m; 0: no surf")
    period: float = Field(default=7.0, ge=2.0, le=20.0, description="Wave period, s")
    skew: float = Field(
        default=0.5,
        ge=0.0,
        le=1.0,
        description="γ: asymmetry of the profile at breaking; 1 is symmetric, smaller values lean toward the shore",
    )
    sharpness: float = Field(
        default=0.05,
        ge=0.0,
        le=0.15,
        description="b: horizontal displacement at the crests, in wavelengths; larger values sharpen them",
    )
    variation: float = Field(
        default=0.7,
        ge=0.0,
        le=1.0,
        description="Strength of the slow variation of the wave height along the coast; 0: all waves break alike",
    )
    heading: float = Field(
        default=0.0,
        ge=-6.2832,
        le=6.2832,
        description="Direction of travel of the swell, rad from +x toward +z",
        json_schema_extra={"unit": "rad"},
    )
    exposure: float = Field(
        default=0.0,
        ge=0.0,
        le=1.0,
        description="Reduction of the surf on coasts that face away from the swell: 0 none, 1 no surf there",
    )


class Shore(_Part):
    """Sea floor and land: a height field over a square; beyond it the floor is level."""

    kind: Literal["beach", "island", "islands", "lagoon", "image"] = Field(
        default="beach",
        description="Shape of the coast. beach: a straight coast across the square; island; islands: several; "
        "lagoon: a ring with an opening; image: heights from `image`",
    )
    place: tuple[_Place, _Place] = Field(default=(0.0, 0.0), description="Centre of the square (x, z), m")
    size: float = Field(default=500.0, ge=40.0, le=10000.0, description="Side of the square, m")
    heading: float = Field(
        default=0.0,
        ge=-6.2832,
        le=6.2832,
        description="Direction of a beach's land, or of a lagoon's opening, rad from +x toward +z",
        json_schema_extra={"unit": "rad"},
    )
    radius: float = Field(default=60.0, ge=1.0, le=4000.0, description="Radius of an island or of a lagoon's ring, m")
    depth: float = Field(default=12.0, ge=0.5, le=1000.0, description="Depth of the level floor offshore, m")
    inner_depth: float = Field(default=3.0, ge=0.2, le=100.0, description="Depth inside a lagoon, m")
    height: float = Field(default=6.0, ge=0.0, le=300.0, description="Approximate height of the land, m")
    slope: float = Field(default=0.06, ge=0.01, le=1.0, description="Slope of the floor at the waterline")
    roughness: float = Field(
        default=0.5, ge=0.0, le=1.0, description="Irregularity of the coastline: bays and capes; 0: the plain shape"
    )
    level: float = Field(
        default=0.0,
        ge=-1000.0,
        le=100.0,
        description="Vertical offset of floor and land, m; negative values raise the water",
    )
    seed: int = Field(default=1, ge=0, le=65535, description="Random seed of the coastline and the terrain")
    image: str | None = Field(
        default=None,
        max_length=8192,
        description="Height map for kind 'image': a base64 PNG, 2 to 128 pixels a side; black is the offshore "
        "depth, white the height of the land; the top row is toward −z",
    )
    smoothing: float = Field(
        default=6.0,
        ge=0.0,
        le=60.0,
        description="Standard deviation of the Gaussian that smooths the distance to the shore, m",
    )
    sand: _Rgb = Field(default=(0.66, 0.56, 0.40), description="Albedo of dry sand, linear RGB")
    rock: _Rgb = Field(default=(0.27, 0.24, 0.21), description="Albedo of rock, on steep ground, linear RGB")
    plants: _Rgb = Field(default=(0.06, 0.10, 0.035), description="Albedo of vegetation, linear RGB")
    plants_from: float = Field(default=2.0, ge=0.0, le=400.0, description="Height above which vegetation grows, m")
    reef: float = Field(
        default=0.5, ge=0.0, le=1.0, description="Fraction of the shallow floor covered by dark reef and seaweed"
    )
    surf: Surf = Field(default_factory=Surf)

    @model_validator(mode="after")
    def _pictured(self) -> "Shore":
        if (self.kind == "image") != (self.image is not None):
            raise ValueError("image: required for kind 'image', and allowed for no other kind")
        if self.image is not None:
            _picture(self.image)
        return self

    @property
    def deep(self) -> float:
        """Depth of the level floor below y = 0, m; at least 0.1, so that divisions by it are safe."""
        return max(self.depth - self.level, 0.1)

    @property
    def ground(self) -> str:
        """Everything that determines the height field, as text; equal texts have the same floor."""
        values = [str(getattr(self, name)) for name in _GROUND]
        if self.image is not None:
            # The alphabet of base64 that addresses take.
            values.append(self.image.replace("+", "-").replace("/", "_"))
        return ",".join(values)

    @staticmethod
    def of_ground(text: str) -> "Shore":
        """Return a shore with the ground described by :attr:`ground`. Raises ``ValueError`` if the text is invalid."""
        values = text.split(",")
        names = _GROUND if len(values) == len(_GROUND) else (*_GROUND, "image")
        if len(values) != len(names):
            raise ValueError(text)
        found = dict(zip(names, values, strict=True))
        if "image" in found:
            found["image"] = found["image"].replace("-", "+").replace("_", "/")
        return Shore.model_validate(found)


_GROUND = (
    "kind",
    "size",
    "heading",
    "radius",
    "depth",
    "inner_depth",
    "height",
    "slope",
    "roughness",
    "level",
    "seed",
)


@lru_cache(maxsize=16)
def _picture(encoded: str) -> Floats:
    """Return the grey values of a base64 PNG, (rows, columns) in [0, 1]. Raises ``ValueError`` with the reason."""
    try:
        raw = base64.b64decode(encoded, validate=True)
    except binascii.Error:
        raise ValueError("image: not valid base64") from None
    try:
        with Image.open(io.BytesIO(raw), formats=("PNG",)) as picture:
            if not (2 <= picture.width <= 128 and 2 <= picture.height <= 128):
                raise ValueError(f"image: {picture.width} × {picture.height} pixels; each side must be 2 to 128")
            deep = picture.mode.startswith("I")
            grey = np.asarray(picture if deep else picture.convert("L"), np.float64) / (65535.0 if deep else 255.0)
    except (OSError, SyntaxError) as error:
        raise ValueError("image: not a readable PNG") from error
    result: Floats = np.clip(grey, 0.0, 1.0)
    result.setflags(write=False)
    return result


def _pictured(grey: Floats, x: Floats, z: Floats) -> Floats:
    """Return the quadratic B-spline of a picture at x, z in [0, 1]; of the shape of ``x``."""
    taps = []
    for place, count in ((z, grey.shape[0]), (x, grey.shape[1])):
        at = place * count - 0.5
        base = np.floor(at + 0.5)
        t = at + 0.5 - base
        index = [np.clip(base.astype(np.int64) + i, 0, count - 1) for i in (-1, 0, 1)]
        taps.append((index, (0.5 * (1.0 - t) ** 2, 0.5 + t * (1.0 - t), 0.5 * t * t)))
    total = np.zeros_like(x)
    for row, down in zip(*taps[0], strict=True):
        for column, along in zip(*taps[1], strict=True):
            total += down * along * grey[row, column]
    return total


def floor_grid(shore: Shore, texels: int) -> Floats:
    """Return (texels, texels, 2): height of floor or land above y = 0 (m), and a tint in [0, 1]; row z, column x.

    Values are at texel centres. Only sums, products, quotients and square roots (and one sine and cosine), rounded to
    1/1024: the same bytes on every machine.
    """
    return _floor_grid(shore.ground, texels)


@lru_cache(maxsize=16)
def _floor_grid(ground: str, texels: int) -> Floats:
    shore = Shore.of_ground(ground)
    half = 0.5 * shore.size
    centres = ((np.arange(texels) + 0.5) / texels - 0.5) * shore.size
    x, z = np.meshgrid(centres, centres, indexing="xy")
    if shore.image is not None:
        grey = _pictured(_picture(shore.image), x / shore.size + 0.5, z / shore.size + 0.5)
        return _finished(shore, x, z, grey * (shore.depth + shore.height) - shore.depth)
    strays = shore.roughness * 0.3 * min(shore.size, 8.0 * shore.radius if shore.kind != "beach" else shore.size)
    e = _plain(shore, x, z) + strays * (_fbm(x, z, 0.3 * shore.size, shore.seed, 5) - 0.5)
    # Whatever the shape, the sea is all round: the floor is level where the square ends.
    edge = np.maximum(np.abs(x), np.abs(z)) - 0.84 * half
    e = 0.5 * (e + edge + np.sqrt((e - edge) ** 2 + (0.04 * shore.size) ** 2))
    sea, land = np.maximum(e, 0.0), np.maximum(-e, 0.0)
    depth = np.full_like(x, shore.depth)
    if shore.kind == "lagoon":
        r = np.sqrt(x * x + z * z)
        depth = shore.inner_depth + (shore.depth - shore.inner_depth) * _smoothstep(0.9, 1.15, r / shore.radius)
    fall = shore.slope * sea / depth
    floor = -depth * fall / np.sqrt(1.0 + fall * fall)
    dune = max(0.3 * shore.height, 1e-3)
    rise = shore.slope * land / dune
    hills = _fbm(x, z, 0.22 * shore.size, shore.seed + 101, 5)
    inland = _smoothstep(0.0, 0.12 * shore.size if shore.kind == "beach" else 0.8 * shore.radius, land)
    rest = shore.height - 0.3 * shore.height
    floor += dune * rise / np.sqrt(1.0 + rise * rise) + rest * inland * (0.25 + 1.1 * hills * hills)
    # Sand ripples and bars, gone at the water's edge and in the deep.
    floor += (
        0.25
        * shore.roughness
        * (_fbm(x, z, 0.06 * shore.size, shore.seed + 211, 3) - 0.5)
        * _smoothstep(0.0, 30.0, np.abs(e))
    )
    # Off the coast it sinks to the deep long before the square ends, and in the round: no edge shows from the air.
    out = np.sqrt(np.sqrt(x**4 + z**4)) / half
    floor += (-shore.depth - floor) * _smoothstep(0.5, 0.95, out) * _smoothstep(0.0, 0.14 * shore.size, e)
    return _finished(shore, x, z, floor)


def _finished(shore: Shore, x: Floats, z: Floats, floor: Floats) -> Floats:
    """Return the floor, levelled toward the edges of the square, with its tint; rounded, read-only."""
    half = 0.5 * shore.size
    # What lies on the edge goes on for ever: nothing may stand there, nor any patch of weed.
    ends = _smoothstep(0.9, 0.985, np.maximum(np.abs(x), np.abs(z)) / half)
    floor = floor + (-shore.depth - floor) * ends
    tint = _fbm(x, z, 0.09 * shore.size, shore.seed + 307, 5)
    tint += (0.4 - tint) * ends
    both = np.stack((floor + shore.level, tint), axis=-1)
    result: Floats = np.round(both * STEPS) / STEPS
    result.setflags(write=False)
    return result


def _plain(shore: Shore, x: Floats, z: Floats) -> Floats:
    """Return the distance to the plain coastline, m: positive at sea."""
    c, s = math.cos(shore.heading), math.sin(shore.heading)
    r = np.sqrt(x * x + z * z)
    match shore.kind:
        case "beach":
            return -(x * c + z * s)
        case "island":
            return r - shore.radius
        case "islands":
            e = np.full_like(x, 2.0 * shore.size)
            for i in range(7):
                draws = [chance(shore.seed + 401, i, k) for k in range(3)]
                at_x, at_z = (0.62 * shore.size * (float(draw) - 0.5) for draw in draws[:2])
                size = shore.radius * (0.35 + 0.65 * float(draws[2]))
                one = np.sqrt((x - at_x) ** 2 + (z - at_z) ** 2) - size
                # Two that come near grow together.
                blend = 0.5 * shore.radius
                share = np.clip(0.5 + 0.5 * (e - one) / blend, 0.0, 1.0)
                e = e + (one - e) * share - blend * share * (1.0 - share)
            return e
        case _:
            width = 0.16 * shore.radius
            along = (x * c + z * s) / np.maximum(r, 1e-6)
            gap: Floats = np.abs(r - shore.radius) - width + 2.2 * width * _smoothstep(0.90, 0.985, along)
            return gap


def _smoothstep(low: float, high: float, x: Floats) -> Floats:
    q = np.clip((x - low) / (high - low), 0.0, 1.0)
    result: Floats = q * q * (3.0 - 2.0 * q)
    return result


def _value_noise(x: Floats, z: Floats, seed: int) -> Floats:
    """Value noise in [0, 1] with cells of size 1, with continuous second derivatives."""
    i, j = np.floor(x), np.floor(z)
    u, v = x - i, z - j
    u = u * u * u * (u * (6.0 * u - 15.0) + 10.0)
    v = v * v * v * (v * (6.0 * v - 15.0) + 10.0)
    a, b = i.astype(np.int64), j.astype(np.int64)
    near = chance(seed, a, b) * (1.0 - u) + chance(seed, a + 1, b) * u
    far = chance(seed, a, b + 1) * (1.0 - u) + chance(seed, a + 1, b + 1) * u
    result: Floats = near * (1.0 - v) + far * v
    return result


def _fbm(x: Floats, z: Floats, cell: float, seed: int, octaves: int) -> Floats:
    """Octaves of value noise, the largest with cells of ``cell`` m; in [0, 1], mean about ½."""
    total, weight, sum_of_weights = np.zeros_like(x), 1.0, 0.0
    for octave in range(octaves):
        # Each octave is turned against the last (3-4-5), so that no lattice shows.
        x, z = 0.8 * x - 0.6 * z, 0.6 * x + 0.8 * z
        total += weight * _value_noise(x / cell, z / cell, seed + 17 * octave)
        sum_of_weights += weight
        weight, cell = 0.5 * weight, 0.47 * cell
    result: Floats = total / sum_of_weights
    return result
