"""What GET requests for frames were found to ask for, so that a repeat is answered without planning."""

from collections import OrderedDict
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from starlette.routing import BaseRoute
from starlette.types import Scope

from seafoam.render.service.jobs import FrameJob

ADDRESS_KEPT = 1024
"""Bytes of a query; all parameters at full length have a third of it."""
REQUESTS_KEPT = 4096
"""Requests whose answer is known without planning; one is a job of which the scene is shared with its preset."""


@dataclass(frozen=True, slots=True)
class Identified:
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
        self._held: OrderedDict[tuple[Any, ...], Identified] = OrderedDict()

    def get(self, scope: Scope, info: Mapping[str, str]) -> Identified | None:
        """Return what this request asked for before, with the same renderer, or None."""
        key = (scope["path"], scope["query_string"], *info.values())
        if key not in self._held:
            return None
        self._held.move_to_end(key)
        return self._held[key]

    def put(self, scope: Scope, info: Mapping[str, str], identified: Identified) -> None:
        """Remember what a request asked for, unless its address is longer than any that is meant."""
        if len(scope["query_string"]) > ADDRESS_KEPT:
            return
        self._held[(scope["path"], scope["query_string"], *info.values())] = identified
        if len(self._held) > REQUESTS_KEPT:
            self._held.popitem(last=False)
