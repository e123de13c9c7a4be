"""A river's current: what floats moves with it. docs/formulae.md, section 16."""

from seafoam.effects.effect import Contribution, Effect, PlanError
from seafoam.quality import Quality
from seafoam.scene.models import Scene


def contribute(scene: Scene, quality: Quality) -> Contribution | None:
    """Active if the scene has a current. The planner moves what effects declare as afloat."""
    current = scene.current
    if current is None:
        return None
    if current.velocity == (0.0, 0.0):
        return Contribution.invisible("the water rests")
    _refuse(scene)
    return Contribution(why=f"a current of {current.speed:g} m/s carries waves, ripples and foam")


def _refuse(scene: Scene) -> None:
    """Raise :class:`PlanError` for what keeps its place over the ground where the current would move or change it."""
    kept = {
        "/rings": bool(scene.rings),
        "/drift": scene.drift is not None,
        "/spray": scene.spray is not None,
        "/shore/surf/height": scene.shore is not None and scene.shore.surf.height > 0.0,
        "/boats": any(boat.speed > 0.0 for boat in scene.boats),
    }
    for pointer, there in kept.items():
        if there:
            raise PlanError(pointer, f"{pointer.rsplit('/', 1)[-1]} cannot be combined with a current")


EFFECT = Effect("current", contribute, fields=("/current",))
