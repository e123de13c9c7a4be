"""Baking the shipped masks: ``python -m seafoam.masks.bake [--out masks]`` constructs, measures and writes them."""

from __future__ import annotations

import argparse
import json
from pathlib import Path

from rich.progress import Progress as ProgressBar

from .catalogue import CATALOGUE_FILE, MaskTables, describe, rank_file
from .construct import estimated_seconds, make_mask
from .formats import encode_ranks
from .shipped import SHIPPED, SHIPPED_METHOD, SHIPPED_SEED, SHIPPED_SIZE, ShippedMask
from .torus import Progress, no_progress

MEASURING_SECONDS = 1.0


def bake_all(directory: Path, progress: Progress = no_progress) -> None:
    """Construct and measure every shipped mask, and write ``<name>.ranks`` files and ``catalogue.json``.

    The directory is made if need be. ``progress`` gets fractions of the expected time. Takes some four minutes:
    the `vac` masks are ordered exactly.
    """
    directory.mkdir(parents=True, exist_ok=True)
    expected = [_expected_seconds(mask) for mask in SHIPPED]
    total = sum(expected)
    records = []
    for index, mask in enumerate(SHIPPED):
        before = sum(expected[:index])

        def report(part: float, before: float = before, own: float = expected[index]) -> None:
            progress((before + part * own) / total)

        records.append(_bake(directory, mask, report))
    # A line a mask, so that the change of one shows as such.
    lines = ",\n".join(json.dumps(record, separators=(",", ":"), allow_nan=False) for record in records)
    (directory / CATALOGUE_FILE).write_text(f'{{"masks": [\n{lines}\n]}}\n', "utf-8")
    progress(1.0)


def _expected_seconds(mask: ShippedMask) -> float:
    return MEASURING_SECONDS + estimated_seconds(mask.family, mask.sigma, SHIPPED_SIZE, method=SHIPPED_METHOD)


def _bake(directory: Path, mask: ShippedMask, progress: Progress) -> dict[str, object]:
    """Write the ranks of one mask and return its record for the catalogue."""
    ranks = make_mask(
        mask.family,
        sigma=mask.sigma,
        size=SHIPPED_SIZE,
        seed=SHIPPED_SEED,
        method=SHIPPED_METHOD,
        progress=progress,
    )
    rank_file(directory, mask.name).write_bytes(encode_ranks(ranks))
    entry = describe(mask.name, mask.family, mask.sigma, SHIPPED_SEED, SHIPPED_METHOD, ranks)
    return {**entry.to_json(), **MaskTables.measure(ranks).to_json()}


def main() -> None:
    """The command."""
    parser = argparse.ArgumentParser(description="Bake the shipped masks and their catalogue.")
    parser.add_argument("--out", type=Path, default=Path("masks"), help="directory to write to")
    directory = parser.parse_args().out
    with ProgressBar() as bar:
        task = bar.add_task("masks", total=1.0)
        bake_all(directory, lambda fraction: bar.update(task, completed=fraction))


if __name__ == "__main__":
    main()
