"""Which EGL device to draw on: the one that is asked for, or else the first that is no software renderer."""

import multiprocessing
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

from pebble import ProcessPool

from seafoam.doctor import PROBE_SECONDS, SOFTWARE
from seafoam.render.gl.executor import Executor, NoRendererError
from seafoam.render.service.worker import draw_canary

MOST = 16
"""Devices that are looked at."""
RASTER = {
    name: (
        f"An {name} runs vertex and pixel shaders in two of its 66 texture processing clusters, 4 of its 132\n"
        "multiprocessors (NVIDIA's white paper on the H100's architecture, 2022), some 2 TFLOP/s: what a processor's\n"
        "integrated GPU has."
    )
    for name in ("H100", "H200")
}
"""What has to be known of a device's figures, by a part of its renderer's name."""
NO_MORE = "requested device index"
"""In what the binding says of an index for which there is no device."""


@dataclass(frozen=True)
class Device:
    """An EGL device and the names that its GL gives; ``problem``: why it does not draw, empty if it does.

    ``index``: None for the driver's default.
    """

    index: int | None
    renderer: str = ""
    version: str = ""
    vendor: str = ""
    problem: str = ""

    @property
    def software(self) -> bool:
        """Whether it draws on the processor."""
        return any(name in self.renderer.lower() for name in SOFTWARE)

    @property
    def note(self) -> str:
        """What has to be known of its figures; empty: nothing."""
        return next((note for name, note in RASTER.items() if name in self.renderer), "")

    def __str__(self) -> str:
        place = "the default device" if self.index is None else f"device {self.index}"
        return f"{place}: {self.problem or self.renderer}"


def choose(found: Sequence[Device]) -> Device:
    """The first that draws and is no software renderer; else the first that draws.

    Raises :class:`NoRendererError` with what is wrong with each if none draws.
    """
    drawing = [device for device in found if not device.problem]
    if not drawing:
        raise NoRendererError("; ".join(map(str, found)))
    return next((device for device in drawing if not device.software), drawing[0])


def survey(asked: int | None, look: Callable[[int | None], Device] | None = None) -> list[Device]:
    """Look at the device that is asked for, or at each; at the default where none of them draws."""
    look = look or probe
    if asked is not None:
        return [look(asked)]
    found = list(_all(look))
    return found if any(not device.problem for device in found) else [*found, look(None)]


def _all(look: Callable[[int | None], Device]) -> Iterator[Device]:
    for index in range(MOST):
        device = look(index)
        if NO_MORE in device.problem:
            return
        yield device


def probe(index: int | None) -> Device:
    """Draw a small picture on a device, in a process of its own: a driver can crash or hang."""
    pool = ProcessPool(max_workers=1, context=multiprocessing.get_context("spawn"))
    try:
        device: Device = pool.schedule(_drawn, args=[index], timeout=PROBE_SECONDS).result()
    except TimeoutError:
        return Device(index, problem=f"no frame within {PROBE_SECONDS:g} s")
    except Exception as error:
        # The process of a driver that crashes ends with one of several errors.
        return Device(index, problem=str(error).partition("; ")[0] or type(error).__name__)
    finally:
        pool.stop()  # type: ignore[no-untyped-call]
        pool.join()
    return device


def _drawn(index: int | None) -> Device:
    executor = Executor(index)
    draw_canary(executor)
    return Device(index, executor.info["renderer"], executor.info["version"], executor.info["vendor"])
