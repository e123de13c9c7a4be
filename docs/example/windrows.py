"""Example of an effect outside the package: windrows, the foam lines that Langmuir circulation lays along the wind.

CONTRIBUTING.md explains this file and ``windrows.glsl``. A test draws them on the server and in the browser and
compares the frame with ``truth``.
"""

import math
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from seafoam.effects.effect import Bound, Contribution, Effect, Extension, QualityParameter, SaturationSource
from seafoam.effects.shader import SlotFile
from seafoam.framegraph.rules import Phase, array, number, vector
from seafoam.quality import Quality, QualityParameters
from seafoam.reference.renderer.sources import SurfacePoints
from seafoam.scene import Angle, Part, Scene

HARMONICS = tuple((1 if m == 0 else 2) * math.comb(16, 8 - m) for m in range(9))
"""65536 cos^16(θ/2) = Σ HARMONICS[m] cos(mθ)."""


class Windrows(Part):
    """Windrows: lines along the wind in which foam gathers."""

    spacing: float = Field(default=14.0, ge=2.0, le=500.0, description="Distance from line to line, m")
    strength: float = Field(default=0.35, ge=0.0, le=4.0, description="Saturation on a line")
    wind_direction: Angle = Field(
        default=0.0, description="Direction toward which the wind blows, rad from +x toward +z"
    )


class WindrowQuality(QualityParameters):
    """Settings of windrows."""

    filter: bool = Field(default=True, description="Average the lines over a sample's footprint; false: they alias")


def across(part: Windrows) -> tuple[float, float]:
    """Wavevector across the lines (x, z), rad/m."""
    k = 2.0 * math.pi / part.spacing
    return -k * math.sin(part.wind_direction), k * math.cos(part.wind_direction)


def contribute(scene: Scene, quality: Quality) -> Contribution | None:
    """Active if the scene has foam and ``extensions.windrows``."""
    part = scene.extensions.given(Windrows)
    if part is None or scene.foam is None:
        return None
    settings = quality.extensions.given(WindrowQuality) or WindrowQuality()
    pointer = "/extensions/windrows/strength"
    return Contribution(
        why=f"windrows {part.spacing:g} m apart",
        slots=(SlotFile("saturation", str(Path(__file__).with_name("windrows.glsl")), prefix="rows"),),
        consts={
            "ROWS_HARMONICS": HARMONICS,
            "ROWS_FILTER": settings.filter and scene.foam.look == "filtered",
        },
        uniforms={
            "u_rows_k": vector(across(part)),
            # The camera position enters here, reduced in float64: the shader's p is relative to the camera.
            "u_rows_phase": array("float", [Phase(offset=0.0, rate=0.0, k=across(part))], 1),
            "u_rows_strength": number(part.strength, pointer),
        },
        bound=None if part.strength > 0.0 else Bound(0.0, "the strength is 0", (pointer,)),
    )


def limit(part: Windrows, scene: Scene) -> float:
    """Greatest saturation: on a line."""
    return part.strength


def truth(part: Windrows, scene: Scene, at: SurfacePoints) -> NDArray[np.float64]:
    """Saturation in float64: cos^16, or its mean over a Gaussian of the footprint's variance (1/12 of its squares)."""
    k_x, k_z = across(part)
    phase = k_x * (at.origin[0] + at.x) + k_z * (at.origin[1] + at.z)
    if at.footprints is None:
        return part.strength * np.cos(0.5 * phase) ** 16
    square = sum((k_x * side[:, 0] + k_z * side[:, 1]) ** 2 for side in at.footprints)
    turns = [count * np.cos(m * phase) * np.exp(-m * m * square / 24.0) for m, count in enumerate(HARMONICS)]
    return part.strength * np.maximum(np.sum(turns, axis=0) / 65536.0, 0.0)


EFFECT = Effect(
    "windrows",
    contribute,
    parameters=(
        QualityParameter(
            "/extensions/windrows/filter", "windrows averaged over footprints", (False, True), "filtering"
        ),
    ),
    saturation=SaturationSource(Windrows, limit, live=("strength",)),
    extension=Extension("windrows", scene=Windrows, quality=WindrowQuality, truth=truth),
)
