"""Generates the shipped masks: ``python -m seafoam.masks.bake [--out masks] [--only NAME ...]``.

It constructs, measures and writes them; with ``--only`` all others keep their ranks, with ``--scheduler
tcp://host:8786`` they are made on the workers of a Dask cluster.
"""

import argparse
import json
from collections.abc import Mapping
from concurrent.futures import Executor, as_completed
from pathlib import Path

from rich.progress import Progress as ProgressBar

from seafoam.extras import UnableError
from seafoam.files import write_whole
from seafoam.masks.catalogue import CATALOGUE_FILE, Mask, MaskTables, describe
from seafoam.masks.construct.make import build, estimated_seconds
from seafoam.masks.families import Family, MaskSpec, Method
from seafoam.masks.formats import decode_ranks, encode_ranks
from seafoam.masks.torus import Progress, no_progress
from seafoam.processes import SCHEDULER, executor

METHOD: Method = "exact"
"""How `vac` is ordered for the catalogue: a mask is baked once, so time is no object."""
MEASURING_SECONDS = 1.0


def _shipped(family: Family, sigma: float, aspect: float = 1.0, age: float = 0.0) -> MaskSpec:
    return MaskSpec(family, sigma, 512, 512, 2011, aspect, age)


SHIPPED: Mapping[str, MaskSpec] = {
    "vac-1.5": _shipped("vac", 1.5),
    "vac-3": _shipped("vac", 3.0),
    "vac-6": _shipped("vac", 6.0),
    "vac-12": _shipped("vac", 12.0),
    "vac-24": _shipped("vac", 24.0),
    "blur-1.5": _shipped("blur", 1.5),
    "blur-6": _shipped("blur", 6.0),
    "blur-24": _shipped("blur", 24.0),
    "clump": _shipped("clump", 1.5),
    "bubble": _shipped("bubble", 4.0),
    "mix": _shipped("mix", 4.0),
    "lace": _shipped("lace", 10.0),
    "lacetorn": _shipped("lace", 15.0, aspect=1.3, age=1.0),
    "streak": _shipped("lace", 11.0, aspect=3.0, age=0.7),
}
"""The baked masks by name."""


def bake_all(
    directory: Path, progress: Progress = no_progress, only: tuple[str, ...] = (), pool: Executor | None = None
) -> None:
    """Construct and measure every shipped mask; write ``<name>.ranks``, ``<name>.tables`` and ``catalogue.json``.

    The directory is made if need be. Where ``only`` names some, the ranks of the others are read there instead of
    made. ``progress`` gets fractions of the expected time. ``pool`` makes them, several at once; else this process
    does, which takes some four minutes: `vac` is ordered exactly.
    """
    directory.mkdir(parents=True, exist_ok=True)
    kept = {name: (directory / f"{name}.ranks").read_bytes() for name in SHIPPED if only and name not in only}
    making = {name: 0.0 if name in kept else estimated_seconds(made, METHOD) for name, made in SHIPPED.items()}
    expected = {name: MEASURING_SECONDS + seconds for name, seconds in making.items()}
    total = sum(expected.values())
    baked: dict[str, _Baked] = {}
    if pool is not None:
        running = {pool.submit(_bake, name, made, kept.get(name)): name for name, made in SHIPPED.items()}
        for done in as_completed(running):
            baked[running[done]] = done.result()
            progress(sum(expected[name] for name in baked) / total)
    else:
        for name, made in SHIPPED.items():
            before = sum(expected[other] for other in baked)

            def report(part: float, before: float = before, own: float = expected[name]) -> None:
                progress((before + part * own) / total)

            baked[name] = _bake(name, made, kept.get(name), report)
    for name in SHIPPED:
        _, ranks, tables = baked[name]
        if name not in kept:
            write_whole(directory / f"{name}.ranks", ranks)
        write_whole(directory / f"{name}.tables", tables)
    records = (baked[name][0] for name in SHIPPED)
    # A line a mask, so that the change of one shows as such.
    lines = ",\n".join(json.dumps(record, separators=(",", ":"), allow_nan=False) for record in records)
    write_whole(directory / CATALOGUE_FILE, f'{{"masks": [\n{lines}\n]}}\n'.encode())
    progress(1.0)


_Baked = tuple[dict[str, object], bytes, bytes]


def _bake(name: str, made: MaskSpec, kept: bytes | None, progress: Progress = no_progress) -> _Baked:
    """Return the record of a mask for the catalogue, its ranks and its tables as files hold them.

    kept: the ranks that it has.
    """
    ranks = build(made, METHOD, progress) if kept is None else decode_ranks(kept, made.width)
    entry = describe(name, made, METHOD, ranks)
    measured = MaskTables.measure(ranks)
    tables = Mask(entry, ranks, measured).filtering.to_bytes()
    return {**entry.model_dump(), **measured.model_dump()}, encode_ranks(ranks), tables


def main() -> None:
    parser = argparse.ArgumentParser(description="Bake the shipped masks and their catalogue.")
    parser.add_argument("--out", type=Path, default=Path("masks"), help="directory to write to")
    others = "masks to make; all others stay unchanged"
    parser.add_argument("--only", nargs="+", choices=tuple(SHIPPED), default=(), help=others)
    parser.add_argument("--scheduler", help=SCHEDULER)
    arguments = parser.parse_args()
    directory, only = arguments.out, tuple(arguments.only)
    with ProgressBar() as bar:
        task = bar.add_task("masks", total=1.0)

        def tell(fraction: float) -> None:
            bar.update(task, completed=fraction)

        if arguments.scheduler is None:
            bake_all(directory, tell, only)
            return
        try:
            with executor(arguments.scheduler, 0) as pool:
                bake_all(directory, tell, only, pool)
        except UnableError as error:
            raise SystemExit(str(error)) from error


if __name__ == "__main__":
    main()
