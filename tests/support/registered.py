"""The inverse of :func:`seafoam.effects.register`."""

from seafoam.effects import registry
from seafoam.effects.effect import Effect
from seafoam.extensions import TRUTHS
from seafoam.quality import QualityExtensions
from seafoam.scene import SceneExtensions


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
