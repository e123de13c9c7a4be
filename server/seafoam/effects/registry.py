"""Registration of effects outside the package, and what all effects declare of foam saturations.

A package that depends on Seafoam registers its effects by entry points of the group ``seafoam.effects``, each an
:class:`~seafoam.effects.effect.Effect`, or calls :func:`register` before it validates a scene.
"""

from collections.abc import Callable
from importlib.metadata import entry_points

from pydantic import BaseModel

from seafoam.effects.effect import Effect, SaturationSource
from seafoam.extensions import TRUTHS
from seafoam.quality import QualityExtensions
from seafoam.scene import Scene, SceneExtensions

GROUP = "seafoam.effects"
"""Entry points that :func:`load` registers."""
_outside: dict[str, Effect] = {}
_saturations: dict[type[BaseModel], SaturationSource] = {}
CHANGED: list[Callable[[], None]] = []
"""Functions to call after a change of the registered effects; they clear caches."""


def outside() -> tuple[Effect, ...]:
    return tuple(_outside.values())


def declare(effect: Effect) -> None:
    """Record the saturation of an effect. Raises ``ValueError`` if another effect has the same model."""
    if effect.saturation is not None:
        if effect.saturation.model in _saturations:
            raise ValueError(f"{effect.name}: {effect.saturation.model.__name__} has an effect already")
        _saturations[effect.saturation.model] = effect.saturation


def register(effect: Effect) -> None:
    """Add an effect from outside the package. Raises ``ValueError`` if its name or its extension's is taken."""
    extension = effect.extension
    taken = SceneExtensions.known.keys() | QualityExtensions.known.keys()
    if effect.name in _outside or (extension is not None and extension.name in taken):
        raise ValueError(f"{effect.name}: registered already")
    declare(effect)
    _outside[effect.name] = effect
    if extension is not None:
        SceneExtensions.known[extension.name] = extension.scene
        if extension.quality is not None:
            QualityExtensions.known[extension.name] = extension.quality
        if extension.truth is not None:
            TRUTHS[extension.scene] = extension.truth
    for clear in CHANGED:
        clear()


def load() -> None:
    """Register the effects of installed packages. Raises the exceptions of their modules."""
    for point in sorted(entry_points(group=GROUP), key=lambda point: point.name):
        register(point.load())


def saturation_limits(scene: Scene) -> list[float]:
    """Return the greatest saturation of each source of a scene, including sources outside the package."""
    return [_saturations[type(source)].limit(source, scene) for source in _sources(scene).values()]


def saturation_fields(scene: Scene) -> tuple[str, ...]:
    """Return JSON pointers of the live fields that :func:`saturation_limits` depends on."""
    sources = _sources(scene).items()
    return tuple(f"{pointer}/{name}" for pointer, source in sources for name in _saturations[type(source)].live)


def _sources(scene: Scene) -> dict[str, BaseModel]:
    given = () if scene.foam is None else scene.foam.saturation
    outside = {f"/extensions/{name}": part for name, part in scene.extensions if type(part) in _saturations}
    return {**{f"/foam/saturation/{i}": source for i, source in enumerate(given)}, **outside}
