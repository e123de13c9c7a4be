"""What GET requests for frames were found to ask for, so that a repeat is answered without planning."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from starlette.routing import BaseRoute
from starlette.types import Scope

from seafoam.render.service.frame_cache import LruCache
from seafoam.render.service.jobs import FrameJob

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


class RequestCache:
    """What GET requests were found to ask for, by their address as it was sent, so that a repeat is neither checked nor
    planned again; the least recently used go first.
    """

    def __init__(self) -> None:
        self._held: LruCache[tuple[Any, ...], ResolvedFrame] = LruCache(REQUESTS_KEPT)

    def get(self, scope: Scope, info: Mapping[str, str]) -> ResolvedFrame | None:
        """Return what this request asked for before, with the same renderer, or None."""
        return self._held.get(_address(scope, info))

    def put(self, scope: Scope, info: Mapping[str, str], resolved: ResolvedFrame) -> None:
        """Remember what a request asked for, unless its address is longer than any that is meant."""
        if len(scope["query_string"]) <= ADDRESS_KEPT:
            self._held.put(_address(scope, info), resolved)


def _address(scope: Scope, info: Mapping[str, str]) -> tuple[Any, ...]:
    return scope["path"], scope["query_string"], *info.values()
