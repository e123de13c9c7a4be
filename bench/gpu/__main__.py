"""``python -m bench.gpu``: draws, compares and measures on this machine's GPU, and writes docs/gpu.md."""

import argparse
import itertools
import multiprocessing
import os
import shlex
import sys
import tempfile
from collections import deque
from collections.abc import Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, wait
from datetime import UTC, datetime
from http.client import HTTPException
from pathlib import Path
from statistics import median
from typing import Any

from pebble import ProcessPool

from bench import machine
from bench.gpu import tasks
from bench.gpu.budget import Budget
from bench.gpu.devices import Device, choose, survey
from bench.gpu.page import Report, Served, page
from bench.gpu.tasks import Drawn, StaleTruthError, Task, order
from bench.served.load import answered
from bench.served.server import REQUEST_SECONDS, closed_loop, running
from seafoam.api.settings import Settings, default_workers
from seafoam.render.gl.executor import NoRendererError
from seafoam.scene import preset_names

PAGE = Path(__file__).resolve().parents[2] / "docs" / "gpu.md"
SECONDS = 300.0
SIZE = (1280, 720)
LARGE = (3840, 2160)
SOFTWARE_SIZE = (160, 90)
MOST_WORKERS = 8
SERVICE_SECONDS = 45.0
SERVICE_SHARE = 0.2
"""Time for the service, at most, and of the whole; it is kept back."""
START_SECONDS = 12.0
"""Of that, for the server to start and to compile."""
STOP_SECONDS = 3.0
LEAST_SECONDS, MOST_SECONDS = 1.0, 6.0
"""Of each load."""
SERVED_PRESET = "default"
FORMATS = ("png", "webp")
NO_TIME = "no time was left"


def main(arguments: Sequence[str] | None = None) -> int:
    """Measure and write the page; 1 if something is wrong, 2 if there is nothing to measure or nowhere to write."""
    asked = _asked(arguments)
    budget = Budget(asked.seconds)
    index = Settings().device_index if asked.device is None else asked.device
    found = survey(index)
    for each in found:
        _say(budget, str(each))
    try:
        device = choose(found)
    except NoRendererError as error:
        print(f"no EGL device draws: {error}", file=sys.stderr)
        return 2
    output = asked.output or PAGE
    if device.software and output.resolve() == PAGE.resolve():
        print(
            f"{device.renderer} draws on the processor, and docs/gpu.md is for GPUs. To see what the page would be: "
            "--output FILE",
            file=sys.stderr,
        )
        return 2
    report = _measured(asked, device, budget)
    given = sys.argv[1:] if arguments is None else arguments
    command = shlex.join([".venv/bin/python", "-m", "bench.gpu", *given]) if given else "make gpu"
    output.write_text(page(report, command), encoding="utf-8")
    for what, why in report.wrong.items():
        print(f"wrong: {what}: {why}", file=sys.stderr)
    _say(budget, f"{report.summary()}; written to {output}")
    return 1 if report.wrong else 0


def _asked(arguments: Sequence[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="python -m bench.gpu", description=__doc__)
    parser.add_argument("--seconds", type=float, default=SECONDS, help="time to keep to (%(default)g)")
    parser.add_argument("--device", type=int, metavar="N", help="EGL device; absent: SEAFOAM_DEVICE_INDEX, or a GPU")
    parser.add_argument("--presets", type=_presets, default=preset_names(), metavar="A,B", help="only these")
    parser.add_argument(
        "--size",
        type=_size,
        metavar="WxH",
        help="of the frames; absent: 1280x720 and, at standard, 3840x2160; of a software renderer 160x90",
    )
    parser.add_argument("--output", type=Path, metavar="FILE", help="absent: docs/gpu.md")
    options = parser.parse_args(arguments)
    part = options.size is not None or options.presets != preset_names()
    if part and (options.output or PAGE).resolve() == PAGE.resolve():
        parser.error("docs/gpu.md has all presets in the usual size; with --presets or --size name another --output")
    return options


def _presets(text: str) -> tuple[str, ...]:
    names = tuple(text.split(","))
    unknown = [name for name in names if name not in preset_names()]
    if unknown:
        raise argparse.ArgumentTypeError(f"no preset {', '.join(unknown)}; there are {', '.join(preset_names())}")
    return names


def _size(text: str) -> tuple[int, int]:
    try:
        width, height = map(int, text.split("x"))
    except ValueError:
        raise argparse.ArgumentTypeError(f"{text} is no size such as 1280x720") from None
    if min(width, height) < 1:
        raise argparse.ArgumentTypeError("a side is at least 1 pixel")
    return width, height


def _say(budget: Budget, what: str) -> None:
    print(f"{budget.spent:5.0f} s  {what}", file=sys.stderr, flush=True)


def _measured(asked: argparse.Namespace, device: Device, budget: Budget) -> Report:
    size = asked.size or (SOFTWARE_SIZE if device.software else SIZE)
    large = None if device.software or asked.size else LARGE
    work = order(asked.presets, size, large)
    about = {
        "GL_RENDERER": device.renderer,
        "GL_VERSION": device.version,
        "GL_VENDOR": device.vendor,
        "EGL device": "default" if device.index is None else str(device.index),
        "date": datetime.now(UTC).strftime("%Y-%m-%d %H:%M UTC"),
        **machine.describe(),
    }
    report = Report(about, device.software, asked.seconds, len(work), device.note)
    reserved = min(SERVICE_SECONDS, SERVICE_SHARE * asked.seconds)
    # A software renderer draws with all cores at once.
    workers = 1 if device.software else max(1, min(MOST_WORKERS, (os.cpu_count() or 1) - 1))
    _draw(report, work, device, workers, budget, reserved)
    _serve(report, device, size, budget)
    about["load at the end"] = machine.load()
    about["taken"] = f"{budget.spent:.0f} s; processes: {workers}, of which one at a time draws"
    return report


def _pool(device: Device, workers: int, turn: Path, queries: bool) -> ProcessPool:
    context = multiprocessing.get_context("spawn")
    given = (device.index, turn, queries)
    return ProcessPool(max_workers=workers, context=context, initializer=tasks.start, initargs=given)


def _draw(report: Report, work: Sequence[Task], device: Device, workers: int, budget: Budget, reserved: float) -> None:
    """Do the pieces of work, as many at once as there are workers, while there is time."""
    with tempfile.TemporaryDirectory() as folder:
        turn = Path(folder) / "turn"
        report.distrust = "the renderer draws on the processor" if device.software else _distrust(device, turn, budget)
        _say(budget, report.distrust or "timer queries of known loads agree with the clock")
        pool = _pool(device, workers, turn, not report.distrust)
        try:
            _schedule(pool, report, deque(work), workers, budget, reserved)
        finally:
            pool.stop()  # type: ignore[no-untyped-call]
            pool.join()


def _distrust(device: Device, turn: Path, budget: Budget) -> str:
    pool = _pool(device, 1, turn, False)
    try:
        reason: str = pool.schedule(tasks.timers, timeout=budget.left()).result()
    except Exception as error:
        # Whatever a driver does at a query: it has no timers then.
        return f"timing a known load failed: {_brief(error)}"
    finally:
        pool.stop()  # type: ignore[no-untyped-call]
        pool.join()
    return reason


def _schedule(
    pool: ProcessPool, report: Report, waiting: deque[Task], workers: int, budget: Budget, reserved: float
) -> None:
    going: dict[Future[Any], tuple[Task, float]] = {}
    number = 0
    while waiting or going:
        # No more than are worked on at once, so that what is not begun is known.
        while waiting and len(going) < workers:
            task = waiting.popleft()
            if not budget.has_room(task.kind, reserved):
                report.skipped[str(task)] = NO_TIME
                continue
            began = budget.spent
            future: Future[Any] = pool.schedule(tasks.perform, args=[task], timeout=budget.left(reserved))
            going[future] = task, began
        done, _ = wait(going, return_when=FIRST_COMPLETED)
        for future in done:
            task, began = going.pop(future)
            number += 1
            budget.took(task.kind, budget.spent - began)
            _say(budget, f"{number} of {report.wanted}: {task}: {_taken(report, task, future)}")


def _taken(report: Report, task: Task, future: Future[Any]) -> str:
    """Take a result into the report; returns it in words."""
    try:
        found = future.result()
    except TimeoutError:
        report.skipped[str(task)] = "begun, and not finished when the time was over"
        return "not finished in time"
    except StaleTruthError as error:
        report.skipped[str(task)] = str(error)
        return str(error)
    except Exception as error:
        # A driver may do anything; the others go on.
        report.failed[str(task)] = _brief(error)
        return f"failed: {_brief(error)}"
    if isinstance(found, Drawn):
        report.drawn.append(found)
        words = f"{1e3 * found.seconds:.2f} ms"
    else:
        report.judged.append(found)
        words = f"below 1° {found.parity.near:.3f}, whole {found.parity.whole:.3f} levels"
    return ", ".join([words, *found.faults])


def _brief(error: Exception) -> str:
    lines = [line.strip() for line in str(error).splitlines() if line.strip()]
    return f"{type(error).__name__}: {lines[0][:200]}" if lines else type(error).__name__


def _serve(report: Report, device: Device, size: tuple[int, int], budget: Budget) -> None:
    """Frames a second of a server with as many workers as it takes by itself, for one client and for two a worker."""
    most = 2 * default_workers()
    loads = list(itertools.product(FORMATS, (1, most)))
    if budget.left() < START_SECONDS + len(loads) * LEAST_SECONDS:
        report.skipped["service"] = NO_TIME
        return
    settings = {"SEAFOAM_DEADLINE": f"{REQUEST_SECONDS:g}"}
    if device.index is not None:
        settings["SEAFOAM_DEVICE_INDEX"] = str(device.index)
    picture = f"{SERVED_PRESET}, {size[0]} × {size[1]}"
    try:
        with running(**settings) as port:
            for form in FORMATS:
                # So many at once that every worker has one, and compiles.
                answered(*closed_loop(port, _paths(form, size), most, 0.1))
            seconds = min(MOST_SECONDS, max(LEAST_SECONDS, (budget.left() - STOP_SECONDS) / len(loads)))
            for form, clients in loads:
                answers, taken = closed_loop(port, _paths(form, size), clients, seconds)
                rate = answered(answers, taken)
                stages = {name: median(each.stages[name] for each in answers) for name in answers[0].stages}
                stages["http"] = median(each.http for each in answers)
                report.served.append(Served(f"{picture}, {form}", clients, rate, stages))
                _say(budget, f"service: {picture}, {form}, for {clients} at once: {rate:.2f} frames/s")
    except (OSError, HTTPException, RuntimeError) as error:
        report.failed["service"] = _brief(error)


_moments = itertools.count()


def _paths(form: str, size: tuple[int, int]) -> Iterator[str]:
    """Frames of ever other times."""
    query = f"width={size[0]}&height={size[1]}"
    return (f"/api/frames/{SERVED_PRESET}.{form}?{query}&time={9.0 + 0.37 * moment:.2f}" for moment in _moments)


if __name__ == "__main__":
    sys.exit(main())
