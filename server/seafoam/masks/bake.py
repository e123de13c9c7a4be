"""Generates the shipped masks: ``python -m seafoam.masks.bake [--out masks] [--only NAME ...]``.

It constructs, measures and writes them; with ``--only`` all others keep their ranks.
"""

from __future__ import annotations

import argparse
import json
from pathlib import Path

from rich.progress import Progress as ProgressBar

from seafoam.masks.catalogue import CATALOGUE_FILE, MaskTables, describe, rank_file
from seafoam.masks.construct import build, estimated_seconds
from seafoam.masks.families import check_parameters
from seafoam.masks.formats import decode_ranks, encode_ranks
from seafoam.masks.shipped import SHIPPED, SHIPPED_METHOD, SHIPPED_SEED, SHIPPED_SIZE, ShippedMask
from seafoam.masks.torus import Progress, no_progress

MEASURING_SECONDS = 1.0


def bake_all(directory: Path, progress: Progress = no_progress, only: tuple[str, ...] = ()) -> None:
    """Construct and measure every shipped mask, and write ``<name>.ranks`` files and ``catalogue.json``.

    The directory is made if need be. Where ``only`` names some, the ranks of the others are read there instead of
    made. ``progress`` gets fractions of the expected time. Takes some four minutes: `vac` is ordered exactly.
    """
    directory.mkdir(parents=True, exist_ok=True)
    made = [not only or mask.name in only for mask in SHIPPED]
    expected = [_expected_seconds(mask, new) for mask, new in zip(SHIPPED, made, strict=True)]
    total = sum(expected)
    records = []
    for index, mask in enumerate(SHIPPED):
        before = sum(expected[:index])

        def report(part: float, before: float = before, own: float = expected[index]) -> None:
            progress((before + part * own) / total)

        records.append(_bake(directory, mask, made[index], report))
    # A line a mask, so that the change of one shows as such.
    lines = ",\n".join(json.dumps(record, separators=(",", ":"), allow_nan=False) for record in records)
    (directory / CATALOGUE_FILE).write_text(f'{{"masks": [\n{lines}\n]}}\n', "utf-8")
    progress(1.0)


def _expected_seconds(mask: ShippedMask, new: bool) -> float:
    making = estimated_seconds(mask.family, mask.sigma, SHIPPED_SIZE, method=SHIPPED_METHOD) if new else 0.0
    return MEASURING_SECONDS + making


def _bake(directory: Path, mask: ShippedMask, new: bool, progress: Progress) -> dict[str, object]:
    """Write the ranks of one mask, or read them where it is not new, and return its record for the catalogue."""
    file = rank_file(directory, mask.name)
    parameters = check_parameters(mask.family, mask.sigma, SHIPPED_SIZE, SHIPPED_SEED, mask.aspect, mask.age)
    if new:
        ranks = build(parameters, SHIPPED_METHOD, progress)
        file.write_bytes(encode_ranks(ranks))
    else:
        ranks = decode_ranks(file.read_bytes(), SHIPPED_SIZE)
    entry = describe(mask.name, parameters, SHIPPED_METHOD, ranks)
    return {**entry.to_json(), **MaskTables.measure(ranks).to_json()}


def main() -> None:
    """The command."""
    parser = argparse.ArgumentParser(description="Bake the shipped masks and their catalogue.")
    parser.add_argument("--out", type=Path, default=Path("masks"), help="directory to write to")
    names = [mask.name for mask in SHIPPED]
    parser.add_argument("--only", nargs="+", choices=names, default=(), help="masks to make; all others stay unchanged")
    arguments = parser.parse_args()
    directory = arguments.out
    with ProgressBar() as bar:
        task = bar.add_task("masks", total=1.0)
        bake_all(directory, lambda fraction: bar.update(task, completed=fraction), tuple(arguments.only))


if __name__ == "__main__":
    main()
