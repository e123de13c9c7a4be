"""Each effect alone: for a scene, the nearest scene that runs an effect and the nearest one that does not.

The switch is searched for: some preset or hard case runs the effect, and of the fields in which it differs from the
scene only those that the effect needs are taken.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

from pydantic import ValidationError

from seafoam.effects import EFFECTS
from seafoam.effects.effect import Effect, PlanError
from seafoam.planner.collect import NEGLIGIBLE
from seafoam.quality import Quality
from seafoam.scene import Scene, load_preset, preset_names
from support.cases import cases_of

Json = dict[str, Any]
Path = tuple[str, ...]


@dataclass(frozen=True)
class Switch:
    """An effect added to a scene, all else unchanged."""

    effect: str
    on: Scene
    off: Scene
    fields: tuple[str, ...]
    """JSON pointers of the fields that differ."""
    needs: tuple[str, ...]
    """JSON pointers of fields that both scenes have in addition to the original, because the effect needs them."""
    given: bool
    """Whether the original scene runs the effect: it is then ``on``, and ``off`` was derived."""
    others: tuple[str, ...]
    """Effects that are added or removed with it, because they depend on it or replace it."""


@lru_cache(maxsize=64)
def running(scene: Scene, quality: Quality) -> frozenset[str]:
    """Return the effects that a plan of the scene would run. Raises ``PlanError`` as planning does."""
    settled = scene.settled
    return frozenset(effect.name for effect in EFFECTS if _shows(effect, settled, quality))


def _shows(effect: Effect, settled: Scene, quality: Quality) -> bool:
    contribution = effect.contribute(settled, quality)
    return contribution is not None and (contribution.bound is None or contribution.bound.value >= NEGLIGIBLE)


def switch(effect: Effect, scene: Scene, quality: Quality) -> Switch | None:
    """Return the effect's switch in a scene; None if no field of any preset or hard case adds it there."""
    usual = running(scene, quality)
    if effect.name in usual:
        return _removed(effect, scene, quality, usual)
    base = _json(scene)
    best: Switch | None = None
    presets = (load_preset(name).scene for name in preset_names())
    for other in (*presets, *(case.scene for case in cases_of(effect).hard)):
        if best is not None and not best.others and not best.needs:
            # One field adds the effect alone: no scene is nearer.
            break
        if not _runs(effect, _json(other), quality):
            continue
        best = _added(effect, base, _json(other), quality, best)
    return best


def _rank(found: Switch) -> tuple[int, int]:
    return len(found.others), len(found.needs)


def _added(effect: Effect, base: Json, donor: Json, quality: Quality, best: Switch | None) -> Switch | None:
    """Return the base with the fewest parts of the donor that run the effect, and that without the decisive part.

    ``best``: of other donors, which is returned where it is as near.
    """
    kept = list(_differences(base, donor))
    if not _runs(effect, _merged(base, donor, kept), quality):
        return best
    for path in list(kept):
        fewer = [other for other in kept if other != path]
        if _runs(effect, _merged(base, donor, fewer), quality):
            kept = fewer
    if best is not None and not best.others and len(kept) > len(best.needs):
        return best
    on = _scene(_merged(base, donor, kept))
    assert on is not None
    now = running(on, quality)
    for path in kept:
        needs = [other for other in kept if other != path]
        off = _scene(_merged(base, donor, needs))
        if off is None:
            continue
        others = tuple(sorted((now ^ running(off, quality)) - {effect.name}))
        found = Switch(effect.name, on, off, _pointers([path]), _pointers(needs), False, others)
        if best is None or _rank(found) < _rank(best):
            best = found
    return best


def _removed(effect: Effect, scene: Scene, quality: Quality, usual: frozenset[str]) -> Switch | None:
    """Return the scene with one field emptied so that the effect is gone, and as few others as possible."""
    base = _json(scene)
    best: tuple[int, Scene, Path, frozenset[str]] | None = None
    for path, value in _emptied(base):
        off = _scene(_with(base, path, value))
        if off is None or _shows(effect, off.settled, quality):
            continue
        now = running(off, quality)
        rank = 10 * len(now ^ usual) + len(path)
        if best is None or rank < best[0]:
            best = rank, off, path, now
    if best is None:
        return None
    _, off, path, now = best
    others = tuple(sorted((now ^ usual) - {effect.name}))
    return Switch(effect.name, scene, off, _pointers([path]), (), True, others)


def _emptied(document: Json) -> Iterator[tuple[Path, Any]]:
    """Return every part with the value that stands for its absence: null, an empty list, 0, or the least angle."""
    for name, value in document.items():
        if name == "camera":
            continue
        nothing: tuple[Any, ...] = (None, [])
        yield from (((name,), empty) for empty in nothing if value != empty)
        if isinstance(value, dict):
            for inner, held in value.items():
                least: tuple[Any, ...] = () if isinstance(held, str) else (None, 0.0, -1.5)
                yield from (((name, inner), empty) for empty in least if held != empty)


def _differences(base: Json, donor: Json) -> Iterator[Path]:
    for name, value in donor.items():
        if name == "camera" or base.get(name) == value:
            continue
        mine = base.get(name)
        if isinstance(mine, dict) and isinstance(value, dict):
            yield from ((name, inner) for inner, held in value.items() if mine.get(inner) != held)
        else:
            yield (name,)


def _merged(base: Json, donor: Json, paths: Sequence[Path]) -> Json:
    """Return the base with the donor's parts; lists are concatenated if both have items."""
    result = base
    for path in paths:
        mine, theirs = _at(base, path), _at(donor, path)
        if isinstance(mine, list) and isinstance(theirs, list) and path[-1] in ("waves", "rings", "saturation"):
            known = {item.get("source") for item in mine}
            own = [item for item in theirs if "source" not in item or item["source"] not in known]
            theirs = [*mine, *own]
        result = _with(result, path, theirs)
    return result


def _at(document: Json, path: Path) -> Any:
    found: Any = document
    for name in path:
        found = found[name]
    return found


def _with(document: Json, path: Path, value: Any) -> Json:
    if len(path) == 1:
        return {**document, path[0]: value}
    return {**document, path[0]: _with(document[path[0]], path[1:], value)}


def _pointers(paths: Sequence[Path]) -> tuple[str, ...]:
    return tuple("/" + "/".join(path) for path in paths)


def _json(scene: Scene) -> Json:
    result: Json = scene.model_dump(mode="json")
    return result


def _scene(document: Json) -> Scene | None:
    try:
        return Scene.model_validate(document)
    except ValidationError:
        return None


def _runs(effect: Effect, document: Json, quality: Quality) -> bool:
    scene = _scene(document)
    try:
        return scene is not None and _shows(effect, scene.settled, quality)
    except PlanError:
        return False
