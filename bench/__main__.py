"""``python -m bench``: measures, then prints everything."""

import argparse
import json
import sys
import traceback
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path

from rich.console import Console
from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn

from bench import compiler, document, machine, start
from bench.drawn import adaptive, budget, economy, effects, foam, frames, motion, passes
from bench.drawn.passes import Frame
from bench.report import Table, lines
from bench.served import engines, http, load, page, server, streams, water_page, yardstick
from bench.watch import Watch
from seafoam.render.gl.executor import Executor
from seafoam.scene import preset_names

USUAL = ("frames", "economy", "effects", "foam", "budget", "yardstick", "passes")
LONG = ("motion", "adaptive", "load", "engines", "streams", "soak", "start")
"""Sections that are measured only where they are named: they take longer than all others together."""
DRAWN = (*USUAL, "motion", "adaptive", "load")
SERVED = ("yardstick", "http", "page", "engines")
SECTIONS = (*DRAWN, "compiler", "http", "page", "engines", "streams", "soak", "start")
QUICK = 0.2


@dataclass
class Run:
    """Results so far, and the machine that they are from."""

    about: dict[str, str] = field(default_factory=machine.describe)
    sections: dict[str, list[Table]] = field(default_factory=dict)
    frames: list[Frame] = field(default_factory=list)

    def add(self, section: str, tables: Sequence[Table]) -> None:
        """Add tables to a section."""
        self.sections.setdefault(section, []).extend(tables)

    @property
    def tables(self) -> list[Table]:
        """All tables, in the order of the sections."""
        return [table for section in SECTIONS for table in self.sections.get(section, [])]


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the requested measurements; returns 1 if a part of them could not be made."""
    asked = _asked(arguments)
    run = Run()
    failure = ""
    console = Console(stderr=True)
    columns = (TextColumn("{task.description}"), BarColumn(), TimeElapsedColumn())
    with Progress(*columns, console=console, disable=not console.is_terminal) as progress:
        watch = Watch(progress, QUICK if asked.quick else 1.0)
        try:
            if set(DRAWN) & set(asked.only):
                _draw(run, asked, watch)
            if "compiler" in asked.only:
                about, tables = compiler.measure(asked.presets, watch, write=asked.write_table)
                run.about |= about
                run.add("compiler", tables)
            if set(SERVED) & set(asked.only):
                _serve(run, asked, watch)
            if "streams" in asked.only:
                run.add("streams", streams.measure(watch))
            if "soak" in asked.only:
                run.add("soak", load.soak(watch))
            if "start" in asked.only:
                run.add("start", start.measure(asked.presets, watch))
        except Exception:
            # Results up to the failure are still printed.
            failure = traceback.format_exc()

    print(lines(run.about))
    for table in run.tables:
        print(f"\n{table.text()}")
    if asked.json:
        figures = {"machine": run.about, "tables": [table.json() for table in run.tables]}
        asked.json.write_text(json.dumps(figures, indent=1) + "\n", encoding="utf-8")
    if failure:
        print(failure, file=sys.stderr)
    elif asked.docs:
        document.write(run.about, run.sections, run.frames)
    return 1 if failure else 0


def _asked(arguments: Sequence[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="python -m bench", description="Measure what Seafoam costs here.")
    parser.add_argument("--quick", action="store_true", help="a fifth of the rounds, rougher figures")
    parser.add_argument("--json", type=Path, metavar="FILE", help="write the figures as JSON, times in seconds")
    parser.add_argument(
        "--only",
        choices=SECTIONS,
        nargs="+",
        default=tuple(name for name in SECTIONS if name not in LONG),
        help=f"measure only these parts, of which {', '.join(LONG)} are left out unless named",
    )
    parser.add_argument(
        "--presets",
        type=_presets,
        default=preset_names(),
        metavar="A,B",
        help="of yardstick, passes, adaptive, compiler and start: only these presets",
    )
    parser.add_argument("--docs", action="store_true", help="write the figures into the pages of docs")
    parser.add_argument(
        "--write-table", action="store_true", help="of compiler: write bench/compiler.json, what its test admits"
    )
    options = parser.parse_args(arguments)
    if (options.docs or options.write_table) and options.presets != preset_names():
        parser.error("--docs and --write-table need all presets")
    if options.write_table and "compiler" not in options.only:
        parser.error("--write-table needs --only compiler")
    return options


def _presets(text: str) -> tuple[str, ...]:
    """Names of presets, separated by commas."""
    names = tuple(text.split(","))
    unknown = [name for name in names if name not in preset_names()]
    if unknown:
        raise argparse.ArgumentTypeError(f"no preset {', '.join(unknown)}; there are {', '.join(preset_names())}")
    return names


def _draw(run: Run, asked: argparse.Namespace, watch: Watch) -> None:
    """Measurements that draw with one executor."""
    executor = Executor()
    try:
        run.about["GL"] = f"{executor.info['renderer']}, {executor.info['version']}"
        drawn = {
            "frames": frames,
            "economy": economy,
            "effects": effects,
            "foam": foam,
            "budget": budget,
            "motion": motion,
            "load": load,
        }
        for name, section in drawn.items():
            if name in asked.only:
                run.add(name, section.measure(executor, watch))
        if "adaptive" in asked.only:
            run.add("adaptive", adaptive.measure(executor, asked.presets, watch))
        if "yardstick" in asked.only:
            with water_page.opened() as three:
                three.require(executor.info["renderer"])
                run.about |= {"three.js": three.revision, "three.js's renderer": three.renderer}
                run.add("yardstick", yardstick.measure(executor, three, asked.presets, watch))
        if "passes" in asked.only:
            run.frames, table = passes.measure(executor, asked.presets, watch)
            run.add("passes", [table])
    finally:
        executor.close()
    run.about["load after the frames"] = machine.load()


def _serve(run: Run, asked: argparse.Namespace, watch: Watch) -> None:
    """Measurements of a running server, and of a browser."""
    if {"yardstick", "http", "page"} & set(asked.only):
        _serve_uncached(run, asked, watch)
    if "engines" in asked.only:
        # As people find it some minutes after its start, with its caches.
        with server.running(SEAFOAM_CACHE_SIZE="", SEAFOAM_CACHE_MEMORY="", MESA_SHADER_CACHE_DISABLE="") as port:
            server.wait_until_compiled(port)
            run.add("engines", engines.measure(port, watch))


def _serve_uncached(run: Run, asked: argparse.Namespace, watch: Watch) -> None:
    with server.running() as port:
        if "yardstick" in asked.only:
            with water_page.opened() as three:
                run.add("yardstick", [yardstick.pictures(port, three, watch)])
        if "http" in asked.only:
            run.add("http", http.measure(port, watch))
            run.about["load after HTTP"] = machine.load()
        if "page" in asked.only:
            browser, tables = page.measure(port, watch)
            run.about |= browser
            run.add("page", tables)
            run.about["load after the page"] = machine.load()


if __name__ == "__main__":
    sys.exit(main())
