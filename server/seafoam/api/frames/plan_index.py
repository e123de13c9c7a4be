"""Scenes and qualities by the hash of their plan, which is an address of frames (``/api/plans/{plan}/frames``)."""

import json
from collections import OrderedDict
from dataclasses import dataclass

from seafoam.planner import PlanError
from seafoam.quality import Quality
from seafoam.render.service.disk import DiskCache
from seafoam.render.service.jobs import plan_hash
from seafoam.scene.models import Scene

KEPT = 1024
"""Plans in memory; one is a few kilobytes of scene."""


@dataclass(frozen=True, slots=True)
class PlanSource:
    """A scene and a quality, from which a plan is made."""

    scene: Scene
    quality: Quality


class PlanIndex:
    """Scenes and qualities by the hash of their plan: in memory, and on disk where there is a cache. Thread-safe.

    Scenes that differ only in what cannot be seen have the same plan; the first one stands for them.
    """

    def __init__(self, disk: DiskCache | None) -> None:
        self._disk = disk
        self._held: OrderedDict[str, PlanSource] = OrderedDict()

    def holds(self, plan: str) -> bool:
        """Whether a plan is in memory."""
        return plan in self._held

    def remember(self, plan: str, scene: Scene, quality: Quality) -> None:
        """Remember what a plan was made from."""
        if self.holds(plan):
            return
        stored = self._read(plan)
        if stored is None and self._disk is not None:
            parts = {"scene": scene.model_dump(mode="json"), "quality": quality.model_dump(mode="json")}
            self._disk.put(_key(plan), json.dumps(parts, sort_keys=True).encode())
        self._hold(plan, stored or PlanSource(scene, quality))

    def find(self, plan: str) -> PlanSource | None:
        """Return what a plan is made from, or None if this server has not made it."""
        if (held := self._held.get(plan)) is not None:
            return held
        stored = self._read(plan)
        if stored is not None:
            self._hold(plan, stored)
        return stored

    def _read(self, plan: str) -> PlanSource | None:
        content = None if self._disk is None else self._disk.get(_key(plan))
        if content is None:
            return None
        try:
            parts = json.loads(content)
            source = PlanSource(Scene.model_validate(parts["scene"]), Quality.model_validate(parts["quality"]))
            # Another version of the program may make another plan of the same scene, or none.
            return source if plan_hash(source.scene, source.quality) == plan else None
        except (ValueError, KeyError, PlanError):
            return None

    def _hold(self, plan: str, source: PlanSource) -> None:
        self._held[plan] = source
        while len(self._held) > KEPT:
            self._held.popitem(last=False)


def _key(plan: str) -> str:
    return f"{plan}-plan"
