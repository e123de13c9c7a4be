"""GL objects that an executor keeps between frames, and their formats as moderngl names them."""

from collections import OrderedDict
from collections.abc import Callable
from typing import Any, Literal

import numpy as np

Output = Literal["rgba8", "rgba16", "linear", "samples"]

TEXTURE_FORMATS = {
    "R8": (1, "f1"),
    "R8UI": (1, "u1"),
    "R16UI": (1, "u2"),
    "RG32UI": (2, "u4"),
    "R16F": (1, "f2"),
    "R32F": (1, "f4"),
    "RG32F": (2, "f4"),
    "RGBA32F": (4, "f4"),
}
"""Components and moderngl dtype of each texture format."""
TARGET_FORMATS = {
    "R16F": (1, "f2"),
    "RGBA16": (4, "nu2"),
    "RGBA16F": (4, "f2"),
    "RGBA32F": (4, "f4"),
    "RGBA8": (4, "f1"),
    "RG32UI": (2, "u4"),
}
"""Components and moderngl dtype of each target format."""
READ: dict[Output, tuple[str, Literal["f1", "nu2", "f4"], type[np.uint8 | np.uint16 | np.float32]]] = {
    "rgba8": ("RGBA8", "f1", np.uint8),
    "rgba16": ("RGBA16", "nu2", np.uint16),
    "linear": ("RGBA8", "f4", np.float32),
    "samples": ("RGBA8", "f4", np.float32),
}
"""Format of the displayed picture's target; moderngl dtype and type of what is read."""


FORMAT_BYTES = {"f1": 1, "u1": 1, "u2": 2, "u4": 4, "f2": 2, "f4": 4}


class Cache:
    """GL objects by key, ``size`` at most; the least recently used are evicted first."""

    def __init__(self, size: int) -> None:
        self._size = size
        self._items: OrderedDict[Any, Any] = OrderedDict()

    def __contains__(self, key: Any) -> bool:
        return key in self._items

    def get(self, key: Any, make: Callable[[], Any]) -> Any:
        """Return the object of a key, created if missing."""
        if key not in self._items:
            self._items[key] = make()
        self._items.move_to_end(key)
        return self._items[key]

    def trim(self) -> None:
        """Release objects over the limit; called between frames, when nothing is in use."""
        while len(self._items) > self._size:
            self.release(self._items.popitem(last=False)[1])

    def clear(self) -> None:
        while self._items:
            self.release(self._items.popitem()[1])

    @staticmethod
    def release(item: Any) -> None:
        for part in item if isinstance(item, tuple) else (item,):
            part.release()
