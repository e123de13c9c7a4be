"""The renderer of this process: one thread owns the GL context, and draws for all others in turn."""

import os
import threading
from concurrent.futures import ThreadPoolExecutor

from seafoam.effects.effect import PlanError
from seafoam.library.request import InvalidRequestError
from seafoam.library.source import MaskRequest, PictureSource
from seafoam.masks.catalogue import load_catalogue, load_mask
from seafoam.masks.construct.make import make_mask
from seafoam.masks.formats import to_npy
from seafoam.render.gl.executor import Executor
from seafoam.render.service.jobs import FrameJob, render_frame

CUSTOM_SIZE = 256
"""Side of masks made on request, texels."""


class Embedded(PictureSource):
    """Draws in this process. A process has one GL context, so there is one instance, :data:`HERE`.

    The context is created by the first frame; after :meth:`close` the next frame creates another. While a frame is
    drawn, Python's lock is held, so other threads pause: a server uses :class:`seafoam.render.service.pool.RenderPool`.
    A process forked from one that has drawn cannot draw (drivers hang there) and says so: use ``spawn``.
    """

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._owner: ThreadPoolExecutor | None = None
        self._executor: Executor | None = None
        self._drew_in: int | None = None
        """Process that has created a context, at any time."""

    def close(self) -> None:
        """Release the GL context, after the frames that were asked for. Without one it does nothing."""
        with self._lock:
            owner, self._owner = self._owner, None
            if owner is None or self._drew_in != os.getpid():  # a forked process has no such thread
                return
            owner.submit(self._release).result()
            owner.shutdown()

    def _draw(self, job: FrameJob) -> bytes:
        with self._lock:
            if self._drew_in not in (None, os.getpid()):
                raise RuntimeError(
                    "this process was forked from one that has drawn, where OpenGL hangs: start processes with "
                    "multiprocessing.get_context('spawn')"
                )
            if self._owner is None:
                self._owner, self._drew_in = ThreadPoolExecutor(1, "seafoam"), os.getpid()
            drawing = self._owner.submit(self._drawn, job)
        return drawing.result()

    def _mask(self, asked: MaskRequest) -> bytes:
        if not asked.given and asked.name in load_catalogue():
            return to_npy(load_mask(asked.name).ranks)
        try:
            return to_npy(make_mask(asked.name, **{"size": CUSTOM_SIZE, **asked.given}))
        except ValueError as error:
            raise InvalidRequestError(f"mask {error}") from error

    def _drawn(self, job: FrameJob) -> bytes:
        if self._executor is None:
            self._executor = Executor(assisted=True)
        try:
            return render_frame(self._executor, job).content
        except PlanError as error:
            raise InvalidRequestError(f"scene{error.pointer}: {error.message}") from error

    def _release(self) -> None:
        executor, self._executor = self._executor, None
        if executor is not None:
            executor.close()


HERE = Embedded()
"""The renderer of this process."""
