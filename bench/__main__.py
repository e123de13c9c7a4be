"""``python -m bench``: measures, then prints everything."""

import argparse
import json
import sys
import traceback
from collections.abc import Sequence
from pathlib import Path

from rich.console import Console
from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn

from bench import budget, compiler, economy, effects, frames, http, machine, page, server, water_page, yardstick
from bench.report import Table
from bench.watch import Watch
from seafoam.render.executor import Executor
from seafoam.scene.presets import preset_names

SECTIONS = ("frames", "economy", "effects", "budget", "yardstick", "compiler", "http", "page")
QUICK = 0.2


def main(arguments: Sequence[str] | None = None) -> int:
    """Run what was asked for; 1 where a part of it could not be measured."""
    parser = argparse.ArgumentParser(prog="python -m bench", description="Measure what Seafoam costs here.")
    parser.add_argument("--quick", action="store_true", help="a fifth of the rounds, rougher figures")
    parser.add_argument("--json", type=Path, metavar="FILE", help="write the figures as JSON, times in seconds")
    parser.add_argument("--only", choices=SECTIONS, nargs="+", default=SECTIONS, help="measure only these parts")
    parser.add_argument(
        "--presets",
        type=_presets,
        default=preset_names(),
        metavar="A,B",
        help="of yardstick and compiler: only these presets",
    )
    parser.add_argument(
        "--write-table", action="store_true", help="of compiler: write bench/compiler.json, what its test admits"
    )
    asked = parser.parse_args(arguments)
    if asked.write_table and ("compiler" not in asked.only or asked.presets != preset_names()):
        parser.error("--write-table needs --only compiler with all presets")

    about = machine.describe()
    tables: list[Table] = []
    failure = ""
    console = Console(stderr=True)
    columns = (TextColumn("{task.description}"), BarColumn(), TimeElapsedColumn())
    with Progress(*columns, console=console, disable=not console.is_terminal) as progress:
        watch = Watch(progress, QUICK if asked.quick else 1.0)
        try:
            if {"frames", "economy", "effects", "budget", "yardstick"} & set(asked.only):
                executor = Executor()
                try:
                    about["GL"] = f"{executor.info['renderer']}, {executor.info['version']}"
                    if "frames" in asked.only:
                        tables += frames.measure(executor, watch)
                    if "economy" in asked.only:
                        tables += economy.measure(executor, watch)
                    if "effects" in asked.only:
                        tables += effects.measure(executor, watch)
                    if "budget" in asked.only:
                        tables += budget.measure(executor, watch)
                    if "yardstick" in asked.only:
                        with water_page.opened() as three:
                            about |= {"three.js": three.revision, "three.js's renderer": three.renderer}
                            tables += yardstick.measure(executor, three, asked.presets, watch)
                finally:
                    executor.close()
                about["load after the frames"] = machine.load()
            if "compiler" in asked.only:
                compiler_info, found = compiler.measure(asked.presets, watch, write=asked.write_table)
                about |= compiler_info
                tables += found
            if {"yardstick", "http", "page"} & set(asked.only):
                with server.running() as port:
                    if "yardstick" in asked.only:
                        with water_page.opened() as three:
                            tables.append(yardstick.pictures(port, three, watch))
                    if "http" in asked.only:
                        tables += http.measure(port, watch)
                        about["load after HTTP"] = machine.load()
                    if "page" in asked.only:
                        browser, found = page.measure(port, watch)
                        about |= browser
                        tables += found
                        about["load after the page"] = machine.load()
        except Exception:
            # What was measured until then is still worth printing.
            failure = traceback.format_exc()

    width = max(map(len, about))
    print("\n".join(f"{name.ljust(width)}  {value}" for name, value in about.items()))
    for table in tables:
        print(f"\n{table.text()}")
    if asked.json:
        figures = {"machine": about, "tables": [table.json() for table in tables]}
        asked.json.write_text(json.dumps(figures, indent=1) + "\n", encoding="utf-8")
    if failure:
        print(failure, file=sys.stderr)
    return 1 if failure else 0


def _presets(text: str) -> tuple[str, ...]:
    """Names of presets with commas between them."""
    names = tuple(text.split(","))
    unknown = [name for name in names if name not in preset_names()]
    if unknown:
        raise argparse.ArgumentTypeError(f"no preset {', '.join(unknown)}; there are {', '.join(preset_names())}")
    return names


sys.exit(main())
