"""The masks on disk and the masks made on request, behind one type."""

import hashlib
import json
from dataclasses import asdict, dataclass
from functools import cache, cached_property
from pathlib import Path
from threading import Lock

import numpy as np
from numpy.typing import NDArray
from pydantic import BaseModel, Field

from seafoam.masks import families, prefilter
from seafoam.masks.construct.make import build, estimated_seconds
from seafoam.masks.families import Family, MaskSpec, Method, parse_parameters
from seafoam.masks.formats import decode_ranks
from seafoam.masks.judge.morphology import MaskMorphology, measure_morphology
from seafoam.masks.judge.spectrum import MaskSpectrum, measure_spectrum
from seafoam.masks.torus import Progress, Ranks
from seafoam.ocean.arrays import read_only
from seafoam.resources import data_dir

CATALOGUE_FILE = "catalogue.json"
ON_REQUEST_SECONDS = 5.0
"""Expected construction time above which custom masks are refused, s."""
CUSTOM_MASKS_KEPT = 16


class UnknownMaskError(KeyError):
    """No shipped mask has that name."""


class MaskTooSlowError(ValueError):
    """A valid request whose construction would take longer than :data:`ON_REQUEST_SECONDS`."""


class QuantileTable(BaseModel, frozen=True):
    """Quantile table for magnification (:func:`prefilter.quantile_table`)."""

    abscissa: str = "entry i of n is Q(s) at t = i / (n - 1); t = sqrt(s / 2) if s <= 1/2, else 1 - sqrt((1 - s) / 2)"
    entries: tuple[float, ...]


class MaskTables(BaseModel, frozen=True):
    """Measurements of a mask."""

    quantile: QuantileTable
    spectrum: MaskSpectrum
    morphology: MaskMorphology

    @staticmethod
    def measure(ranks: Ranks) -> "MaskTables":
        """Measure a mask; about a second at 512 x 512."""
        return MaskTables(
            quantile=QuantileTable(entries=tuple(float(f"{q:.6g}") for q in prefilter.quantile_table(ranks))),
            spectrum=measure_spectrum(ranks),
            morphology=measure_morphology(ranks),
        )


class MaskParameters(BaseModel, frozen=True):
    """Parameters that determine a mask."""

    sigma: float = Field(description="Characteristic length of the family, texels")
    width: int = Field(description="Width of the tile, texels")
    height: int = Field(description="Height of the tile, texels")
    seed: int
    aspect: float | None = Field(description="Aspect ratio of the cells along x; null except for lace")
    age: float | None = Field(description="Age of the foam, 0 (young) to 1 (old and torn); null except for lace")
    method: Method | None = Field(description="Ordering method of vac; null for other families")


class MaskInfo(BaseModel, frozen=True):
    """A mask's description and construction parameters."""

    name: str
    title: str
    summary: str
    family: Family
    parameters: MaskParameters
    generator: str = Field(description="Version of the construction algorithm")
    sha256: str = Field(description="SHA-256 of the ranks as little-endian uint32, in row-major order")
    value_rule: str
    license: str


@dataclass(frozen=True, slots=True, eq=False)
class Thresholds:
    """Tables by which shaders threshold a mask, 65 entries a row, read-only. Half a second at 512 x 512 to compute."""

    quantiles: NDArray[np.float64]
    """Of the magnified mask, then of each level of :attr:`Mask.spans`."""
    ramps: NDArray[np.float64]
    """Of the ramp of an octave, see :func:`prefilter.ramp_tables`."""

    @staticmethod
    def from_bytes(content: bytes) -> "Thresholds":
        """Read a ``.tables`` file: the rows of both, float64, little-endian."""
        rows = np.frombuffer(content, "<f8").reshape(-1, prefilter.QUANTILE_ENTRIES)
        # Of n levels there are n + 1 rows of quantiles and n + 2 of ramps.
        quantiles, ramps = np.split(rows, [len(rows) // 2])
        return Thresholds(read_only(quantiles), read_only(ramps))


@dataclass(frozen=True, eq=False)
class Mask:
    """A mask with its description; everything else is computed from the ranks on first use."""

    entry: MaskInfo
    ranks: Ranks
    """(height, width) uint32, read-only, each of 0..N-1 once."""
    measured: MaskTables | None = None
    """Its tables if known in advance: those of the catalogue."""
    baked: Thresholds | None = None
    """What :attr:`filtering` is, if known in advance: that of the mask's file."""

    @cached_property
    def tables(self) -> MaskTables:
        """Its spectrum and filtering tables: the known ones, else measured now."""
        return self.measured or MaskTables.measure(self.ranks)

    @property
    def quantile(self) -> tuple[float, ...]:
        return self.tables.quantile.entries

    @cached_property
    def thresholds(self) -> NDArray[np.float64]:
        """u = (rank + 0.5) / N; (height, width) float64, read-only."""
        return read_only(prefilter.thresholds(self.ranks))

    @cached_property
    def spans(self) -> tuple[prefilter.Level, ...]:
        """Mip chain of (low, width), see :func:`prefilter.spans`; read-only."""
        return tuple(read_only(level) for level in prefilter.spans(self.ranks, self.quantile))

    @cached_property
    def filtering(self) -> Thresholds:
        """Its tables for shaders: the known ones, else computed now."""
        if self.baked:
            return self.baked
        quantiles = np.vstack((np.asarray(self.quantile)[None], prefilter.span_quantiles(self.spans)))
        return Thresholds(read_only(quantiles), read_only(prefilter.ramp_tables(self.quantile, self.spans)))

    def sidecar(self) -> dict[str, object]:
        """Metadata of a download, as plain JSON values."""
        return {**self.entry.model_dump(), **self.tables.model_dump()}


def rank_sha256(ranks: Ranks) -> str:
    """SHA-256, in hexadecimal, of the ranks as little-endian uint32, row by row."""
    return hashlib.sha256(ranks.astype("<u4").tobytes()).hexdigest()


def describe(name: str, made: MaskSpec, method: Method, ranks: Ranks) -> MaskInfo:
    """The entry of a mask just constructed with these arguments."""
    given = asdict(made)
    family: Family = given.pop("family")
    lace = family == "lace"
    own = f", aspect {made.aspect:g}, age {made.age:g}" if lace else ""
    length = "spacing" if family == "bubble" else "sigma"
    return MaskInfo(
        name=name,
        title=f"{families.FAMILY_TITLES[family]}, {length} {made.sigma:g} texels{own}",
        summary=families.FAMILY_SUMMARIES[family],
        family=family,
        parameters=MaskParameters(
            **given | ({} if lace else {"aspect": None, "age": None}), method=method if family == "vac" else None
        ),
        generator=families.GENERATOR,
        sha256=rank_sha256(ranks),
        value_rule=families.VALUE_RULE,
        license=families.LICENSE,
    )


@cache
def read_catalogue(directory: Path) -> dict[str, tuple[MaskInfo, MaskTables]]:
    """Entries and tables of the catalogue in a directory, by name, in shipping order.

    Raises ``FileNotFoundError`` if there is none.
    """
    items = json.loads((directory / CATALOGUE_FILE).read_text("utf-8"))["masks"]
    return {item["name"]: (MaskInfo.model_validate(item), MaskTables.model_validate(item)) for item in items}


def load_catalogue() -> dict[str, MaskInfo]:
    """The shipped masks by name, in shipping order."""
    return {name: entry for name, (entry, _tables) in read_catalogue(data_dir("masks")).items()}


@cache
def load_mask(name: str) -> Mask:
    """A shipped mask. Raises :class:`UnknownMaskError` for another name; the mask is kept for later calls."""
    directory = data_dir("masks")
    shipped = read_catalogue(directory)
    if name not in shipped:
        raise UnknownMaskError(f"mask {name!r} was not found; available: {', '.join(shipped)}")
    entry, tables = shipped[name]
    ranks = read_only(decode_ranks((directory / f"{name}.ranks").read_bytes(), entry.parameters.width))
    return Mask(entry, ranks, tables, Thresholds.from_bytes((directory / f"{name}.tables").read_bytes()))


_kept: dict[MaskSpec, Mask] = {}
"""Masks made on request, the one last asked for at the end."""
_kept_lock = Lock()


def mask_by_name(name: str) -> Mask:
    """A shipped mask, or one made on request that is named by its parameters (:data:`families.TEXT_FORM`).

    Raises :class:`UnknownMaskError` for an unknown name, ``ValueError`` for parameters out of range.
    """
    if ":" not in name:
        return load_mask(name)
    return made_on_request(parse_parameters(name))


def drawn_mask(name: str) -> Mask:
    """As :func:`mask_by_name`, of the masks that scenes can draw: square, a power of two up to 512 texels a side."""
    if ":" in name and (asked := parse_parameters(name)).size not in map(str, families.SIZES):
        sizes = ", ".join(map(str, families.SIZES))
        raise ValueError(f"size {asked.size} is not one of {sizes} texels, which a scene can draw")
    return mask_by_name(name)


def made_on_request(parameters: MaskSpec, limit: float | None = None, progress: Progress = lambda _: None) -> Mask:
    """The mask of checked parameters; ``vac`` is ordered in batches.

    The latest :data:`CUSTOM_MASKS_KEPT` are kept. Raises :class:`MaskTooSlowError` for one that is not kept and would
    take longer than ``limit``, s; absent: :data:`ON_REQUEST_SECONDS`.
    """
    limit = ON_REQUEST_SECONDS if limit is None else limit
    with _kept_lock:
        if (kept := _kept.pop(parameters, None)) is not None:
            _kept[parameters] = kept
            return kept
    seconds = estimated_seconds(parameters)
    if seconds > limit:
        raise MaskTooSlowError(
            f"a {parameters.family} mask of sigma {parameters.sigma:g} at size {parameters.size} would take about "
            f"{seconds:.0f} s to generate; the limit is {limit:g} s: lower sigma or size"
        )
    ranks = read_only(build(parameters, progress=progress))
    mask = Mask(describe(parameters.text.replace(":", "-"), parameters, "batched", ranks), ranks)
    with _kept_lock:
        _kept[parameters] = mask
        if len(_kept) > CUSTOM_MASKS_KEPT:
            del _kept[next(iter(_kept))]
    return mask


def is_kept(parameters: MaskSpec) -> bool:
    """Whether :func:`made_on_request` has this mask at once."""
    return parameters in _kept
