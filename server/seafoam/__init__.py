"""Seafoam: real-time water with halftoned foam.

    import seafoam
    seafoam.frame("default", time=9, size=(1280, 720)).save("sea.png")

docs/python.md describes the names below; each is imported when it is first used, so that importing the package costs
nothing. Within the package, import from the packages below this one.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from seafoam.library import (
        InvalidRequestError,
        ServerError,
        close,
        connect,
        encoded,
        encoded_async,
        frame,
        frame_async,
        linear,
        linear_async,
        mask,
        mask_async,
        preset,
        presets,
    )
    from seafoam.notebook import Water
    from seafoam.quality import Quality
    from seafoam.render.gl.context import NoRendererError
    from seafoam.scene.camera import Camera
    from seafoam.scene.models import Scene

__all__ = [
    "Camera",
    "InvalidRequestError",
    "NoRendererError",
    "Quality",
    "Scene",
    "ServerError",
    "Water",
    "close",
    "connect",
    "encoded",
    "encoded_async",
    "frame",
    "frame_async",
    "linear",
    "linear_async",
    "mask",
    "mask_async",
    "preset",
    "presets",
]

_ELSEWHERE = {
    "Camera": "seafoam.scene.camera",
    "NoRendererError": "seafoam.render.gl.context",
    "Quality": "seafoam.quality",
    "Scene": "seafoam.scene.models",
    "Water": "seafoam.notebook",
}


def __getattr__(name: str) -> Any:
    if name not in __all__:
        raise AttributeError(f"module 'seafoam' has no attribute {name!r}")
    value = getattr(import_module(_ELSEWHERE.get(name, "seafoam.library")), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return [*globals(), *__all__]
