"""Where pictures come from: one set of methods, for this process and for a server."""

import asyncio
import io
from abc import ABC, abstractmethod
from collections.abc import Callable, Coroutine
from dataclasses import KW_ONLY, dataclass
from functools import wraps
from typing import Any, Concatenate, ParamSpec, TypeVar

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from seafoam.library.request import FileRequest, PictureRequest, asking
from seafoam.render.service.jobs import FrameJob

P = ParamSpec("P")
R = TypeVar("R")
S = TypeVar("S")


@dataclass(frozen=True)
class MaskRequest:
    """A mask by name or, where anything is given, by family."""

    name: str
    _: KW_ONLY
    sigma: float | None = None
    size: int | tuple[int, int] | None = None
    seed: int | None = None
    aspect: float | None = None
    age: float | None = None

    @property
    def given(self) -> dict[str, Any]:
        """What is given beside the name."""
        return {name: value for name, value in vars(self).items() if name != "name" and value is not None}


def in_a_thread(method: Callable[Concatenate[S, P], R]) -> Callable[Concatenate[S, P], Coroutine[Any, Any, R]]:
    """Return the method's form that does not block the event loop."""

    @wraps(method)
    async def called(self: S, /, *args: P.args, **options: P.kwargs) -> R:
        return await asyncio.to_thread(method, self, *args, **options)

    return called


class PictureSource(ABC):
    """Draws frames and makes masks. Every method can be called from any thread; a source is a context manager.

    Methods raise ``TypeError`` for a keyword that they do not have, :class:`seafoam.InvalidRequestError` for what is
    not allowed, and what their source raises: :class:`seafoam.NoRendererError` or :class:`seafoam.ServerError`.
    """

    @asking(PictureRequest)
    def frame(self, asked: PictureRequest) -> Image.Image:
        """Return a frame as an RGB image, sRGB; ``info["seafoam"]`` is its recipe (JSON).

        what: a preset's name, a :class:`seafoam.Scene`, or a scene's fields as JSON has them. What is absent is the
        preset's, or of a scene 0 s and 1280 × 720. time: s, |time| ≤ 1e9. size: width and height, pixels. quality:
        a tier such as ``standard``, a :class:`seafoam.Quality`, or the settings that differ from ``standard``. camera:
        a :class:`seafoam.Camera`, or the fields that differ from the scene's. look, mask: of the foam; a mask is a
        shipped one, or ``family:sigma:size:seed[:aspect:age]``.
        """
        image = Image.open(io.BytesIO(self._draw(asked.job())))
        image.load()
        return image

    @asking(PictureRequest)
    def linear(self, asked: PictureRequest) -> NDArray[np.float32]:
        """Return a frame as (height, width, 4) float32, top row first: linear RGB, and the coverage of foam, 0..1.

        Options: see :meth:`frame`.
        """
        return _array(self._draw(asked.job("npy")))

    @asking(FileRequest)
    def encoded(self, asked: FileRequest) -> bytes:
        """Return a frame as a file: the bytes that ``seafoam render`` writes.

        format: ``png``, ``webp``, ``exr`` or ``npy``. Other options: see :meth:`frame`.
        """
        return self._draw(asked.job(asked.format))

    @asking(MaskRequest)
    def mask(self, asked: MaskRequest) -> NDArray[np.float32]:
        """Return a mask's thresholds u, (height, width) float32 in (0, 1): foam shows where its saturation exceeds u.

        name: a shipped mask such as ``vac-24``, or with any option a family such as ``vac``, which is made. sigma:
        characteristic length, texels; absent: the family's. size: the side, or width and height, texels: 32 to 1024,
        256 if absent. seed: 0 (absent) to 2³² - 1. aspect: 1 (absent) to 6, and age: 0 (absent) to 1, of ``lace``.
        Ranges: docs/masks.md.
        """
        return _array(self._mask(asked))

    frame_async = in_a_thread(frame)
    linear_async = in_a_thread(linear)
    encoded_async = in_a_thread(encoded)
    mask_async = in_a_thread(mask)

    @abstractmethod
    def close(self) -> None:
        """Release what the source holds, after the pictures that it is drawing."""

    @abstractmethod
    def _draw(self, job: FrameJob) -> bytes:
        """Draw a frame and encode it in its format."""

    @abstractmethod
    def _mask(self, asked: MaskRequest) -> bytes:
        """Make or fetch a mask, as an NPY file."""

    def __enter__(self) -> "PictureSource":
        return self

    def __exit__(self, *_: Any) -> None:
        self.close()


def _array(content: bytes) -> NDArray[np.float32]:
    array: NDArray[np.float32] = np.load(io.BytesIO(content), allow_pickle=False)
    return array
