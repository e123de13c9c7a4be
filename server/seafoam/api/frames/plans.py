"""Frame plans and frames of requests: found once, kept, and found again by their hash or address."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

from pydantic import BaseModel
from starlette.routing import BaseRoute
from starlette.types import Scope

from seafoam.effects.registry import CHANGED
from seafoam.framegraph.plan import FramePlan
from seafoam.planner import PlanError, make_plan
from seafoam.quality import Quality
from seafoam.render.service.frame_cache import DiskCache, LruCache
from seafoam.render.service.jobs import FrameJob, plan_hash
from seafoam.scene import Scene

KEPT = 1024
"""Plans whose scene and quality are in memory; one is a few kilobytes."""


@dataclass(frozen=True, slots=True)
class CompiledPlan:
    """A plan, its canonical JSON and the SHA-256 of that JSON."""

    plan: FramePlan
    content: bytes
    sha256: str


@lru_cache(maxsize=64)
def compile_scene(scene: Scene, quality: Quality) -> CompiledPlan:
    """Compile a scene into a plan. Raises :class:`PlanError`, of which an answer names what set the value at fault."""
    plan = make_plan(scene, quality)
    return CompiledPlan(plan, plan.canonical_json(), plan_hash(scene, quality))


CHANGED.append(compile_scene.cache_clear)


class PlanSource(BaseModel):
    """A scene and a quality, from which a plan is made."""

    scene: Scene
    quality: Quality


class PlanIndex:
    """Scenes and qualities by the hash of their plan: in memory, and on disk where there is a cache. Thread-safe.

    Scenes that differ only in what cannot be seen have the same plan; the first one stands for them.
    """

    def __init__(self, disk: DiskCache | None) -> None:
        self._disk = disk
        self._held: LruCache[str, PlanSource] = LruCache(KEPT)

    def holds(self, plan: str) -> bool:
        return plan in self._held

    def remember(self, plan: str, scene: Scene, quality: Quality) -> None:
        if self.find(plan) is None:
            source = PlanSource(scene=scene, quality=quality)
            if self._disk is not None:
                self._disk.put(f"{plan}-plan", source.model_dump_json().encode())
            self._held.put(plan, source)

    def find(self, plan: str) -> PlanSource | None:
        """Return what a plan is made from, or None if this server has not made it."""
        if (held := self._held.get(plan)) is not None:
            return held
        stored = self._read(plan)
        if stored is not None:
            self._held.put(plan, stored)
        return stored

    def _read(self, plan: str) -> PlanSource | None:
        content = None if self._disk is None else self._disk.get(f"{plan}-plan")
        try:
            source = PlanSource.model_validate_json(content or b"")
            # Another version of the program may make another plan of the same scene, or none.
            return source if plan_hash(source.scene, source.quality) == plan else None
        except (ValueError, PlanError):
            return None


ADDRESS_KEPT = 1024
"""Bytes of a query; all parameters at full length have a third of it."""
REQUESTS_KEPT = 4096
"""Requests whose answer is known without planning; one is a job of which the scene is shared with its preset."""


@dataclass(frozen=True, slots=True)
class ResolvedFrame:
    """A frame that is known before it is drawn: its key, and the headers of its answer."""

    job: FrameJob
    key: str
    headers: Mapping[str, str]
    """All of the answer's but the content's own."""
    route: BaseRoute


RequestCache = LruCache[tuple[Any, ...], ResolvedFrame]
"""By :func:`address_of`, so that a repeat is neither checked nor planned again."""


def address_of(scope: Scope, info: Mapping[str, str]) -> tuple[Any, ...]:
    """Return a request's address as it was sent, with the renderer that it would be answered by."""
    return scope["path"], scope["query_string"], *info.values()
