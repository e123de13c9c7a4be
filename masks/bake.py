"""Generates the shipped masks: ``python masks/bake.py [--out masks] [--only NAME ...] [--scheduler tcp://host:8786]``.

It constructs, measures and writes them, in processes here or on the workers of a Dask cluster; with ``--only`` all
others keep their ranks.
"""

import argparse
import json
from collections.abc import Mapping, Sequence
from concurrent.futures import Executor
from pathlib import Path

import numpy as np
from rich.progress import track

from seafoam.extras import UnableError
from seafoam.files import write_whole
from seafoam.masks.catalogue import CATALOGUE_FILE, Mask, MaskTables, describe
from seafoam.masks.construct.make import build
from seafoam.masks.families import Family, MaskSpec
from seafoam.masks.formats import decode_ranks
from seafoam.masks.torus import Ranks
from seafoam.processes import SCHEDULER, executor

PROCESSES = 2
RANK_BITS = 18
"""Bits of a rank in a ``.ranks`` file: enough for 512 x 512."""


def _shipped(family: Family, sigma: float, aspect: float = 1.0, age: float = 0.0) -> MaskSpec:
    return MaskSpec(family, sigma, 512, 512, 2011, aspect, age)


SHIPPED: Mapping[str, MaskSpec] = {
    **{f"vac-{sigma:g}": _shipped("vac", sigma) for sigma in (1.5, 3.0, 6.0, 12.0, 24.0)},
    **{f"blur-{sigma:g}": _shipped("blur", sigma) for sigma in (1.5, 6.0, 24.0)},
    "clump": _shipped("clump", 1.5),
    "bubble": _shipped("bubble", 4.0),
    "mix": _shipped("mix", 4.0),
    "lace": _shipped("lace", 10.0),
    "lacetorn": _shipped("lace", 15.0, aspect=1.3, age=1.0),
    "streak": _shipped("lace", 11.0, aspect=3.0, age=0.7),
}
"""The baked masks by name."""


def encode_ranks(ranks: Ranks) -> bytes:
    """Lossless ``.ranks`` file: the low 16 bits of every rank, little-endian, then the high 2 bits, four to a byte.

    18 bits a rank, close to the log2(N!) bits that a permutation takes. The first texel of four is in the lowest
    bits. Raises ``ValueError`` if a rank needs more than 18 bits.
    """
    flat = ranks.ravel()
    if flat.size % 4 or int(flat.max()) >> RANK_BITS:
        raise ValueError(f"{flat.size} ranks do not fit {RANK_BITS} bits in groups of four")
    high = (flat >> 16).astype(np.uint8).reshape(-1, 4)
    packed = high[:, 0] | high[:, 1] << 2 | high[:, 2] << 4 | high[:, 3] << 6
    return (flat & 0xFFFF).astype("<u2").tobytes() + packed.tobytes()


def bake_all(directory: Path, pool: Executor, only: Sequence[str] = ()) -> None:
    """Construct and measure every shipped mask; write ``<name>.ranks``, ``<name>.tables`` and ``catalogue.json``.

    The directory is made if need be. Where ``only`` names some, the ranks of the others are read there instead of
    made. ``pool`` makes them; `vac` is ordered exactly, which takes some 45 s a mask.
    """
    directory.mkdir(parents=True, exist_ok=True)
    kept = {name: (directory / f"{name}.ranks").read_bytes() for name in SHIPPED if only and name not in only}
    baking = [pool.submit(_bake, name, made, kept.get(name)) for name, made in SHIPPED.items()]
    lines = []
    for name, baked in zip(SHIPPED, track(baking, "masks"), strict=True):
        record, ranks, tables = baked.result()
        write_whole(directory / f"{name}.ranks", ranks)
        write_whole(directory / f"{name}.tables", tables)
        lines.append(record)
    # A line a mask, so that the change of one shows as such.
    write_whole(directory / CATALOGUE_FILE, '{{"masks": [\n{}\n]}}\n'.format(",\n".join(lines)).encode())


def _bake(name: str, made: MaskSpec, kept: bytes | None) -> tuple[str, bytes, bytes]:
    """Return the record of a mask for the catalogue, its ranks and its tables as files hold them.

    kept: the ranks that it has.
    """
    ranks = build(made, exact=True) if kept is None else decode_ranks(kept, made.width)
    entry = describe(name, made, "exact", ranks)
    measured = MaskTables.measure(ranks)
    filtering = Mask(entry, ranks, measured).filtering
    record = json.dumps({**entry.model_dump(), **measured.model_dump()}, separators=(",", ":"), allow_nan=False)
    return record, encode_ranks(ranks), np.vstack((filtering.quantiles, filtering.ramps)).astype("<f8").tobytes()


def main() -> None:
    parser = argparse.ArgumentParser(description="Bake the shipped masks and their catalogue.")
    parser.add_argument("--out", type=Path, default=Path(__file__).parent, help="directory to write to")
    others = "masks to make; all others stay unchanged"
    parser.add_argument("--only", nargs="+", choices=tuple(SHIPPED), default=(), help=others)
    parser.add_argument("--scheduler", help=SCHEDULER)
    given = parser.parse_args()
    try:
        with executor(given.scheduler, PROCESSES) as pool:
            bake_all(given.out, pool, given.only)
    except UnableError as error:
        raise SystemExit(str(error)) from error


if __name__ == "__main__":
    main()
