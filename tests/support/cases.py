"""Test scenes of the effects: hard cases, scenes that cannot show an effect, variants of its shaders."""

import importlib
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path

from seafoam.effects import registry
from seafoam.effects.effect import Effect
from seafoam.extensions import TRUTHS
from seafoam.quality import QualityExtensions
from seafoam.scene import SceneExtensions
from support.hard.mutations import IN_FLOAT32, Replaced
from support.scenes import Camera, Scene


@dataclass(frozen=True)
class Bounds:
    """How far a picture may be from another.

    ``mean``: of the pixels' largest differences, levels of linear light, display white = 255. ``share``: of pixels that
    are off by more than 2 levels, in [0, 1].
    """

    mean: float
    share: float


EYE = Camera(position=(0.37, 1.2, -0.21), yaw=1.0, pitch=-0.12)
"""Low over the water, and along no axis of anything."""


@dataclass(frozen=True)
class HardCase:
    """A scene, a time and a camera that provoke a failure, and the guard against it, which ``without`` takes out.

    Its pictures show the guard. One that no picture shows is for a test of its function (``tests/gpu/numerics``).
    """

    name: str
    scene: Scene
    guard: str
    times: tuple[float, ...] = (0.0,)
    camera: Camera = EYE
    bounds: Bounds = Bounds(mean=0.5, share=0.01)
    """Against the float64 reference, at the tests' exact quality."""
    without: Replaced = field(default_factory=dict)
    """The guard taken out: the pictures must fail then."""


def reduced(
    name: str, scene: Scene, what: str, camera: Camera = EYE, times: tuple[float, ...] = (-1e9, 1e9)
) -> HardCase:
    """A case of thirty years or ten thousand kilometres; ``what``: what is reduced in float64, which GLSL has not."""
    guard = f"{what} reduced in float64 (framegraph/evaluation.py)"
    return HardCase(name, scene, guard, times, camera, without=IN_FLOAT32)


@dataclass(frozen=True)
class Cases:
    """Test scenes of an effect. ``hard``: scenes that provoke a numerical failure.

    ``invisible``: scenes that contain the effect but cannot show it. ``always_visible``: why there are no such scenes.
    ``variants``: scenes that between them need every file and every compile-time switch of the effect; browsers compile
    them.
    """

    hard: tuple[HardCase, ...] = ()
    invisible: tuple[Scene, ...] = ()
    always_visible: str = ""
    variants: tuple[Scene, ...] = ()


@cache
def _of_the_package() -> dict[str, Cases]:
    """Every ``CASES`` of ``tests/cases``."""
    folder = Path(__file__).parents[1]
    names = (".".join(file.relative_to(folder).with_suffix("").parts) for file in folder.glob("cases/**/[!_]*.py"))
    return {effect: cases for name in names for effect, cases in importlib.import_module(name).CASES.items()}


def cases_of(effect: Effect) -> Cases:
    """The effect's entry in a ``CASES`` of ``tests/cases``, or of ``NAME_cases`` beside an effect outside the package.

    Raises ``ImportError`` or ``KeyError`` where it has none.
    """
    module = effect.contribute.__module__
    if module.startswith("seafoam."):
        return _of_the_package()[effect.name]
    return importlib.import_module(f"{module}_cases").CASES[effect.name]


def unregister(effect: Effect) -> None:
    """Remove an effect that was registered."""
    del registry._outside[effect.name]
    if effect.saturation is not None:
        del registry._saturations[effect.saturation.model]
    if effect.extension is not None:
        SceneExtensions.known.pop(effect.extension.name)
        QualityExtensions.known.pop(effect.extension.name, None)
        TRUTHS.pop(effect.extension.scene, None)
    for clear in registry.CHANGED:
        clear()
