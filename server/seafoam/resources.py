"""Where the data files are: beside the sources in a checkout, inside the package in a wheel."""

from pathlib import Path
from typing import Literal

_PACKAGE = Path(__file__).resolve().parent
_CHECKOUT = _PACKAGE.parent.parent
_IN_CHECKOUT = {"shaders": "shaders", "masks": "masks", "webclient": "webclient/dist"}


def data_dir(kind: Literal["shaders", "masks", "webclient"]) -> Path:
    """Directory that holds the GLSL files, the baked masks or the built web client.

    The wheel carries all three under ``seafoam/_data``; a checkout keeps them at its top level.
    """
    installed = _PACKAGE / "_data" / kind
    return installed if installed.is_dir() else _CHECKOUT / _IN_CHECKOUT[kind]
