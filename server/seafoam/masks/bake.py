"""Generates the shipped masks: ``python -m seafoam.masks.bake [--out masks] [--only NAME ...]``.

It constructs, measures and writes them; with ``--only`` all others keep their ranks, with ``--scheduler
tcp://host:8786`` they are made on the workers of a Dask cluster.
"""

import argparse
import json
from concurrent.futures import Executor, as_completed
from dataclasses import dataclass
from pathlib import Path

from rich.progress import Progress as ProgressBar

from seafoam.extras import UnableError
from seafoam.files import write_whole
from seafoam.masks.catalogue import CATALOGUE_FILE, Mask, MaskTables, describe
from seafoam.masks.construct.make import build, estimated_seconds
from seafoam.masks.families import Family, Method, check_parameters
from seafoam.masks.formats import decode_ranks, encode_ranks
from seafoam.masks.torus import Progress, no_progress
from seafoam.processes import SCHEDULER, executor

SHIPPED_SIZE = 512
SHIPPED_SEED = 2011
SHIPPED_METHOD: Method = "exact"
"""How `vac` is ordered for the catalogue: a mask is baked once, so time is no object."""
MEASURING_SECONDS = 1.0


@dataclass(frozen=True, slots=True)
class ShippedMask:
    """One baked mask: its name and how it is made at :data:`SHIPPED_SIZE` from :data:`SHIPPED_SEED`."""

    name: str
    family: Family
    sigma: float
    aspect: float = 1.0
    age: float = 0.0


SHIPPED: tuple[ShippedMask, ...] = (
    ShippedMask("vac-1.5", "vac", 1.5),
    ShippedMask("vac-3", "vac", 3.0),
    ShippedMask("vac-6", "vac", 6.0),
    ShippedMask("vac-12", "vac", 12.0),
    ShippedMask("vac-24", "vac", 24.0),
    ShippedMask("blur-1.5", "blur", 1.5),
    ShippedMask("blur-6", "blur", 6.0),
    ShippedMask("blur-24", "blur", 24.0),
    ShippedMask("clump", "clump", 1.5),
    ShippedMask("bubble", "bubble", 4.0),
    ShippedMask("mix", "mix", 4.0),
    ShippedMask("lace", "lace", 10.0),
    ShippedMask("lacetorn", "lace", 15.0, aspect=1.3, age=1.0),
    ShippedMask("streak", "lace", 11.0, aspect=3.0, age=0.7),
)


def bake_all(
    directory: Path, progress: Progress = no_progress, only: tuple[str, ...] = (), pool: Executor | None = None
) -> None:
    """Construct and measure every shipped mask; write ``<name>.ranks``, ``<name>.tables`` and ``catalogue.json``.

    The directory is made if need be. Where ``only`` names some, the ranks of the others are read there instead of
    made. ``progress`` gets fractions of the expected time. ``pool`` makes them, several at once; else this process
    does, which takes some four minutes: `vac` is ordered exactly.
    """
    directory.mkdir(parents=True, exist_ok=True)
    kept = [
        (directory / f"{mask.name}.ranks").read_bytes() if only and mask.name not in only else None for mask in SHIPPED
    ]
    making = [estimated_seconds(mask.family, mask.sigma, SHIPPED_SIZE, method=SHIPPED_METHOD) for mask in SHIPPED]
    expected = [MEASURING_SECONDS + (of if old is None else 0.0) for of, old in zip(making, kept, strict=True)]
    total = sum(expected)
    baked: dict[int, _Baked] = {}
    if pool is not None:
        running = {pool.submit(_bake, mask, SHIPPED_SIZE, kept[i]): i for i, mask in enumerate(SHIPPED)}
        for done in as_completed(running):
            baked[running[done]] = done.result()
            progress(sum(expected[i] for i in baked) / total)
    else:
        for index, mask in enumerate(SHIPPED):
            before = sum(expected[:index])

            def report(part: float, before: float = before, own: float = expected[index]) -> None:
                progress((before + part * own) / total)

            baked[index] = _bake(mask, SHIPPED_SIZE, kept[index], report)
    records = []
    for index, mask in enumerate(SHIPPED):
        record, ranks, tables = baked[index]
        if kept[index] is None:
            write_whole(directory / f"{mask.name}.ranks", ranks)
        write_whole(directory / f"{mask.name}.tables", tables)
        records.append(record)
    # A line a mask, so that the change of one shows as such.
    lines = ",\n".join(json.dumps(record, separators=(",", ":"), allow_nan=False) for record in records)
    write_whole(directory / CATALOGUE_FILE, f'{{"masks": [\n{lines}\n]}}\n'.encode())
    progress(1.0)


_Baked = tuple[dict[str, object], bytes, bytes]


def _bake(mask: ShippedMask, size: int, kept: bytes | None, progress: Progress = no_progress) -> _Baked:
    """Return the record of a mask for the catalogue, its ranks and its tables as files hold them.

    kept: the ranks that it has.
    """
    parameters = check_parameters(mask.family, mask.sigma, size, SHIPPED_SEED, mask.aspect, mask.age)
    ranks = build(parameters, SHIPPED_METHOD, progress) if kept is None else decode_ranks(kept, size)
    entry = describe(mask.name, parameters, SHIPPED_METHOD, ranks)
    measured = MaskTables.measure(ranks)
    tables = Mask(entry, ranks, measured).filtering.to_bytes()
    return {**entry.model_dump(), **measured.model_dump()}, encode_ranks(ranks), tables


def main() -> None:
    parser = argparse.ArgumentParser(description="Bake the shipped masks and their catalogue.")
    parser.add_argument("--out", type=Path, default=Path("masks"), help="directory to write to")
    names = [mask.name for mask in SHIPPED]
    parser.add_argument("--only", nargs="+", choices=names, default=(), help="masks to make; all others stay unchanged")
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
