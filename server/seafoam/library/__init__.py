"""The package's interface for Python programs and notebooks; :mod:`seafoam` gives its names.

Pictures come from a :class:`seafoam.library.source.PictureSource`: the renderer of this process (:data:`HERE`), or a
server (:func:`connect`).
"""

from seafoam.library.connection import Connection
from seafoam.library.embedded import HERE
from seafoam.library.request import preset as preset
from seafoam.scene import preset_names

frame = HERE.frame
frame_async = HERE.frame_async
linear = HERE.linear
linear_async = HERE.linear_async
encoded = HERE.encoded
encoded_async = HERE.encoded_async
mask = HERE.mask
mask_async = HERE.mask_async
close = HERE.close
connect = Connection


def presets() -> tuple[str, ...]:
    """Return the names of all presets, in the order of the page's menu."""
    return preset_names()
