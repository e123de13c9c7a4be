"""Seafoam: real-time water with halftoned foam.

    import seafoam
    seafoam.frame("default", time=9, size=(1280, 720)).save("sea.png")

docs/python.md describes the names below; each is imported when it is first used, so that importing the package costs
nothing. Within the package, import from the packages below this one.
"""

from importlib import import_module as _import_module
from importlib.util import find_spec as _find_spec
from typing import TYPE_CHECKING
from typing import Any as _Any

if TYPE_CHECKING:
    from seafoam.library import (
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
    from seafoam.library.request import InvalidRequestError, ServerError
    from seafoam.notebook import Water
    from seafoam.quality import EXACT, Quality
    from seafoam.render.gl.context import NoRendererError
    from seafoam.scene import Camera, Scene

    __version__: str

__all__ = [
    "EXACT", "Camera", "InvalidRequestError", "NoRendererError", "Quality", "Scene", "ServerError", "Water", "close",
    "connect", "encoded", "encoded_async", "frame", "frame_async", "linear", "linear_async", "mask", "mask_async",
    "preset", "presets",
]  # fmt: skip

# A star import, help() and completion read every name that is listed: not the one that raises without its extra.
if _find_spec("anywidget") is None:
    __all__.remove("Water")

_ELSEWHERE = {
    "EXACT": "seafoam.quality",
    "Camera": "seafoam.scene",
    "InvalidRequestError": "seafoam.library.request",
    "NoRendererError": "seafoam.render.gl.context",
    "Quality": "seafoam.quality",
    "Scene": "seafoam.scene",
    "ServerError": "seafoam.library.request",
    "Water": "seafoam.notebook",
}


def __getattr__(name: str) -> _Any:
    if name == "__version__":
        value = _import_module("importlib.metadata").version("seafoam")
    elif name in __all__ or name in _ELSEWHERE:
        value = getattr(_import_module(_ELSEWHERE.get(name, "seafoam.library")), name)
    else:
        raise AttributeError(f"module 'seafoam' has no attribute {name!r}")
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted({*__all__, *(name for name in globals() if name.startswith("__")), "__version__"})
