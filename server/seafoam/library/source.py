"""Where pictures come from: one set of methods, for this process and for a server."""

import asyncio
import io
from abc import ABC, abstractmethod
from concurrent.futures import Future
from dataclasses import dataclass
from typing import Any, TypedDict, Unpack

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from seafoam.library.request import CameraLike, QualityLike, SceneLike, Size, job_of
from seafoam.render.encode import FrameFormat
from seafoam.render.service.jobs import FrameJob


class FrameOptions(TypedDict, total=False):
    """Options of a frame; absent ones are the preset's, or of a scene 0 s and 1280 × 720."""

    time: float | None
    """s, |time| ≤ 1e9."""
    size: Size | None
    """Width and height, pixels."""
    quality: QualityLike
    """Absent: standard."""
    camera: CameraLike | None
    look: str | None
    """Look of the foam."""
    mask: str | None
    """Mask of the foam: a shipped one, or ``family:sigma:size:seed[:aspect:age]``."""


class MaskOptions(TypedDict, total=False):
    """Options of a mask that is made; ranges: docs/masks.md."""

    sigma: float | None
    """Characteristic length, texels; absent: the family's."""
    size: int
    """Side, texels: 32, 64, 128, 256 (default) or 512."""
    seed: int
    """0 (default) to 2³² − 1."""
    aspect: float
    """1 (default) to 6; only of ``lace``."""
    age: float
    """0 (default) to 1; only of ``lace``."""


@dataclass(frozen=True)
class MaskRequest:
    """A mask by name or, where there are options, by family."""

    name: str
    options: MaskOptions


class Source(ABC):
    """Draws frames and makes masks. Every method can be called from any thread; a source is a context manager.

    Methods raise :class:`seafoam.library.errors.InvalidRequestError` for what is not allowed, and what their source
    raises: :class:`seafoam.render.gl.executor.NoRendererError` here, :class:`seafoam.library.errors.ServerError` there.
    """

    def frame(self, what: SceneLike = "default", **options: Unpack[FrameOptions]) -> Image.Image:
        """Return a frame as an RGB image, sRGB; ``info["seafoam"]`` is its recipe (JSON)."""
        return _image(self._draw(job_of(what, **options)).result())

    def linear(self, what: SceneLike = "default", **options: Unpack[FrameOptions]) -> NDArray[np.float32]:
        """Return a frame as (height, width, 4) float32, top row first: linear RGB, and the coverage of foam, 0..1."""
        return _array(self._draw(job_of(what, format="npy", **options)).result())

    def encoded(
        self, what: SceneLike = "default", format: FrameFormat = "png", **options: Unpack[FrameOptions]
    ) -> bytes:
        """Return a frame as a file: the bytes that ``seafoam render`` writes."""
        return self._draw(job_of(what, format=format, **options)).result()

    def mask(self, name: str, **options: Unpack[MaskOptions]) -> NDArray[np.float32]:
        """Return a mask's thresholds u, (size, size) float32 in (0, 1): foam shows where its saturation exceeds u.

        name: a shipped mask such as ``vac-24``, or with any option a family such as ``vac``, which is made.
        """
        return _array(self._mask(MaskRequest(name, options)).result())

    async def frame_async(self, what: SceneLike = "default", **options: Unpack[FrameOptions]) -> Image.Image:
        """:meth:`frame`, without blocking the event loop."""
        return _image(await asyncio.wrap_future(self._draw(job_of(what, **options))))

    async def linear_async(self, what: SceneLike = "default", **options: Unpack[FrameOptions]) -> NDArray[np.float32]:
        """:meth:`linear`, without blocking the event loop."""
        return _array(await asyncio.wrap_future(self._draw(job_of(what, format="npy", **options))))

    async def encoded_async(
        self, what: SceneLike = "default", format: FrameFormat = "png", **options: Unpack[FrameOptions]
    ) -> bytes:
        """:meth:`encoded`, without blocking the event loop."""
        return await asyncio.wrap_future(self._draw(job_of(what, format=format, **options)))

    async def mask_async(self, name: str, **options: Unpack[MaskOptions]) -> NDArray[np.float32]:
        """:meth:`mask`, without blocking the event loop."""
        return _array(await asyncio.wrap_future(self._mask(MaskRequest(name, options))))

    @abstractmethod
    def close(self) -> None:
        """Release what the source holds, after the pictures that it is drawing."""

    @abstractmethod
    def _draw(self, job: FrameJob) -> Future[bytes]:
        """Start to draw a frame and encode it in its format."""

    @abstractmethod
    def _mask(self, asked: MaskRequest) -> Future[bytes]:
        """Start to make or fetch a mask, as an NPY file."""

    def __enter__(self) -> "Source":
        return self

    def __exit__(self, *_: Any) -> None:
        self.close()


def _image(content: bytes) -> Image.Image:
    image = Image.open(io.BytesIO(content))
    image.load()
    return image


def _array(content: bytes) -> NDArray[np.float32]:
    array: NDArray[np.float32] = np.load(io.BytesIO(content), allow_pickle=False)
    return array
