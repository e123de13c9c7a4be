"""The scene model. SI units, right-handed, +y up, radians.

An effect whose part is absent is off. Unknown keys are rejected. Every number declares its unit and range here, and the
OpenAPI document, the panel of the web client and the validation errors are all generated from these descriptions.
"""

from typing import Self

from pydantic import Field

from seafoam.extensions import Extensible, Extensions
from seafoam.scene.base import Part, settled
from seafoam.scene.boats import BOATS_MOST, Boat
from seafoam.scene.camera import Camera
from seafoam.scene.foam import Drift, Foam
from seafoam.scene.light import Light, Wind
from seafoam.scene.shore import Shore
from seafoam.scene.spray import Spray
from seafoam.scene.water import Current, Water
from seafoam.scene.waves import RINGS_MOST, TOUCHES_MOST, Breaker, ParametricWave, Ring, Sea, Touch, WaveGroups


class SceneExtensions(Extensions):
    """Parts that effects outside the package add to a scene, by name; absent: the effect is off."""


class Scene(Extensible, Part):
    """A scene: water, foam, shore, objects, light and camera."""

    wind: Wind | None = None
    """Wind that parts follow which have none of their own; absent: each has its default"""
    waves: tuple[ParametricWave, ...] = Field(default=(), max_length=16)
    rings: tuple[Ring, ...] = Field(default=(), max_length=RINGS_MOST)
    """Circular waves from stones, drops and blasts"""
    touches: tuple[Touch, ...] = Field(default=(), max_length=TOUCHES_MOST)
    """Touches of the water, each of which raises a small ring"""
    sea: Sea | None = Field(default=None, description="Wind-driven open sea; absent: none")
    foam: Foam | None = Field(default=None, description="Foam; absent: none")
    water: Water = Field(default_factory=Water)
    wave_groups: WaveGroups | None = None
    """Groups in which the parametric waves travel; absent: each wave has one height"""
    shore: Shore | None = Field(default=None, description="Sea floor, land and surf; absent: open sea")
    current: Current | None = None
    """Current of a river, which carries all that is on the water; absent: none"""
    drift: Drift | None = None
    """Flow that carries the foam of a drift saturation; absent: no flow"""
    spray: Spray | None = Field(default=None, description="Drops thrown up by waves and surf; absent: none")
    boats: tuple[Boat, ...] = Field(default=(), max_length=BOATS_MOST, description="Boats on the water")
    breaker: Breaker | None = Field(default=None, description="A plunging crest; absent: none")
    light: Light | None = Field(default_factory=Light)
    """Sun, sky and haze; null: unlit, white foam on black"""
    camera: Camera = Field(default_factory=Camera)
    extensions: SceneExtensions = Field(default=SceneExtensions(), exclude_if=lambda given: not dict(given))
    """Parts of effects outside the package, by name; absent: off"""

    @property
    def settled(self) -> Self:
        """The scene with its wind in its parts, where each has what of it is in effect: what all that draws reads."""
        return settled(self.model_copy(update={"wind": None}), {} if self.wind is None else dict(self.wind))
