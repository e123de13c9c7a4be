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


RequestCache = LruCache[tuple[Any, ...], ResolvedFrame]
"""By :func:`address_of`, so that a repeat is neither checked nor planned again."""


def address_of(scope: Scope, info: Mapping[str, str]) -> tuple[Any, ...]:
    """Return a request's address as it was sent, with the renderer that it would be answered by."""
    return scope["path"], scope["query_string"], *info.values()
