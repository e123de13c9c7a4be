"""Programs compiled ahead of the first visitor: a process draws every preset once, small, for the driver to keep.

A software driver compiles a preset's programs in 3 to 10 s, and loads in one what another process has compiled into the
driver's cache on disk. The process has the least priority and ends when it is done, or with its server.
"""

import asyncio
import logging
import multiprocessing
import os
import time
from collections.abc import Callable

from seafoam.quality import TIERS, Tier
from seafoam.render.gl.compilers import driver_keeps
from seafoam.render.gl.executor import NoRendererError
from seafoam.render.service.errors import RenderError, StartingError
from seafoam.render.service.jobs import Renderer
from seafoam.render.service.pool import RenderPool
from seafoam.render.service.worker import draw_canary
from seafoam.scene import load_preset, preset_names

log = logging.getLogger(__name__)

AHEAD: tuple[Tier, ...] = ("fast", "standard")
"""Tiers whose programs are compiled ahead: of the page's frames in motion, and of its frames at rest."""


def draw_ahead(factory: Callable[[], Renderer], parent: int) -> None:
    """Draw everything once, unless the parent ends before; the body of the process.

    factory: creates the renderer. parent: process id of the server.
    """
    os.nice(19)
    os.environ["LP_NUM_THREADS"] = "1"
    renderer = factory()
    others = [name for name in preset_names() if name != "default"]
    # The preset with which the page opens first, at all tiers.
    pairs = [("default", tier) for tier in AHEAD] + [(name, tier) for tier in AHEAD for name in others]
    for name, tier in pairs:
        if os.getppid() != parent:
            return
        try:
            draw_canary(renderer, load_preset(name).scene, TIERS[tier])
        except NoRendererError:
            continue  # Blank frames are the workers' to report.
        except RuntimeError as error:
            log.warning("%s at %s was not compiled ahead: %s", name, tier, error)


async def compile_ahead(pool: RenderPool, factory: Callable[[], Renderer]) -> None:
    """Compile once the pool is ready, in a process of its own; cancelled: end that process."""
    if not driver_keeps():
        return
    while True:
        try:
            await pool.wait_until_settled()
            break
        except StartingError:
            continue
        except RenderError:
            return
    process = multiprocessing.get_context("spawn").Process(
        target=draw_ahead, args=(factory, os.getpid()), name="compile ahead", daemon=True
    )
    began = time.monotonic()
    process.start()
    try:
        await asyncio.to_thread(process.join)
        if process.exitcode == 0:
            log.info("The programs of all presets were compiled ahead in %.0f s", time.monotonic() - began)
    finally:
        process.kill()
