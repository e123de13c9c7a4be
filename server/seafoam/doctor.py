"""Checks what this machine has and what is missing, with the command that installs it."""

import multiprocessing
import re
import sys
from collections.abc import Callable
from concurrent.futures.process import BrokenProcessPool
from dataclasses import dataclass
from typing import Literal

from pebble import ProcessExpired, ProcessPool

from seafoam.extras import MissingExtraError, require
from seafoam.resources import data_dir

PROBE_SECONDS = 60.0
SOFTWARE = ("llvmpipe", "softpipe", "swiftshader", "swrast")
BRANCHING = (24, 3)
"""The first Mesa whose llvmpipe leaves out what no pixel of a group needs."""

State = Literal["good", "missing", "optional"]


@dataclass(frozen=True, slots=True)
class Finding:
    """Result of one check. ``missing``: frames cannot be rendered without it; ``optional``: they can."""

    what: str
    state: State
    detail: str
    remedy: str = ""


def probe_renderer() -> dict[str, str]:
    """Draw a small picture in this process and return the GL's names; runs in a separate process, which GL can crash.

    Raises :class:`seafoam.render.gl.executor.NoRendererError`.
    """
    from seafoam.render.gl.executor import Executor
    from seafoam.render.service.worker import draw_canary

    executor = Executor()
    draw_canary(executor)
    return executor.info


def examine(probe: Callable[[], dict[str, str]] = probe_renderer) -> list[Finding]:
    """Check everything that rendering and the server need. Takes seconds; starts a process."""
    python = Finding("Python", "good", sys.version.split()[0])
    return [python, *_renderer(probe), _masks(), _webclient(), _reports()]


def able_to_render(findings: list[Finding]) -> bool:
    """Whether everything that rendering requires is present."""
    return all(finding.state != "missing" for finding in findings)


def _renderer(probe: Callable[[], dict[str, str]]) -> list[Finding]:
    pool = ProcessPool(max_workers=1, context=multiprocessing.get_context("spawn"))
    try:
        info = pool.schedule(probe, timeout=PROBE_SECONDS).result()
    except (ProcessExpired, BrokenProcessPool):
        remedy = "update or reinstall the GL driver: apt-get install --reinstall libgl1-mesa-dri"
        return [Finding("OpenGL", "missing", "the driver crashed while drawing", remedy)]
    except TimeoutError:
        return [Finding("OpenGL", "missing", f"no frame within {PROBE_SECONDS:g} s", "update the GL driver")]
    except Exception as error:
        # Whatever the driver's bindings raise, the text says what to do.
        problem, _, remedy = str(error).partition("; ")
        return [Finding("OpenGL", "missing", problem, remedy)]
    finally:
        pool.stop()  # type: ignore[no-untyped-call]
        pool.join()
    software = any(name in info["renderer"].lower() for name in SOFTWARE)
    kind = "software, correct but slow" if software else "hardware"
    return [
        Finding("OpenGL", "good", f"{info['renderer']} ({kind})"),
        Finding("", "good", f"{info['vendor']}, {info['version']}"),
        Finding("GLSL ES 3.00", "good", "compiles; a test frame was drawn"),
        *_mesa(info["version"] if software else ""),
    ]


def _mesa(version: str) -> list[Finding]:
    """What an old software renderer costs, by GL's version."""
    found = re.search(r"Mesa (\d+)\.(\d+)", version)
    if found is None or (int(found[1]), int(found[2])) >= BRANCHING:
        return []
    detail = f"{found[1]}.{found[2]} renders frames 1 to 1.4 times as long as 25, docs/performance.md"
    remedy = "Debian 13 has Mesa 25; Debian 12: apt-get install -t bookworm-backports libegl-mesa0 libgl1-mesa-dri"
    return [Finding("Mesa", "optional", detail, remedy)]


def _masks() -> Finding:
    from seafoam.masks.catalogue import load_catalogue

    directory = data_dir("masks")
    try:
        names = list(load_catalogue())
    except (OSError, ValueError, KeyError) as error:
        return Finding("Masks", "missing", f"no catalogue in {directory}: {error}", "reinstall seafoam")
    absent = [name for name in names if not (directory / f"{name}.ranks").is_file()]
    if absent:
        return Finding("Masks", "missing", f"data missing for: {', '.join(absent)}", "reinstall seafoam")
    return Finding("Masks", "good", f"{len(names)} in {directory}")


def _webclient() -> Finding:
    index = data_dir("webclient") / "index.html"
    if index.is_file():
        return Finding("Web client", "good", f"built, {index.parent}")
    return Finding("Web client", "optional", "not built; the server shows a text page at /", "make webclient")


def _reports() -> Finding:
    try:
        require("reports")
    except MissingExtraError as error:
        return Finding("Reports", "optional", str(error).partition("; ")[0], error.remedy)
    return Finding("Reports", "good", "plots and measurements of accuracy")
