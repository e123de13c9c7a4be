"""The mask families, their parameters and ranges.

A family has one length parameter, ``sigma``, in texels; ``lace`` also has an aspect and an age:

======== ==========================================================================
family   meaning of ``sigma``
======== ==========================================================================
vac      standard deviation of the Gaussian that measures voids and clusters
blur     standard deviation of the Gaussian that filters the white noise
clump    narrow Gaussian of the difference of Gaussians; the wide one is 4 sigma
bubble   mean distance between bubble sites (rounded so that an integer number fits)
mix      both: narrow Gaussian of its clumps, and distance between its bubble sites
lace     spacing of the finest of the three grids of its coarse cells
======== ==========================================================================
"""

import math
import re
from dataclasses import dataclass
from typing import Literal, get_args

Family = Literal["vac", "blur", "clump", "bubble", "mix", "lace"]
Method = Literal["exact", "batched"]
FAMILIES: tuple[Family, ...] = get_args(Family)
METHODS: tuple[Method, ...] = get_args(Method)
GENERATOR = "seafoam-masks/1"
"""Version of the construction algorithm; incremented whenever the same arguments would give other ranks."""
LICENSE = "CC0-1.0"
VALUE_RULE = "u = (rank + 0.5) / N; foam shows where f > u; data, linear, toroidal"
SIDE_MIN, SIDE_MAX = 32, 1024
"""Range of the width and the height of a tile, texels."""
SIZES: tuple[int, ...] = (32, 64, 128, 256, 512)
"""Sides of the square masks that scenes can draw: the filtered look halves them down to one texel."""
SIGMA_MIN = 0.5
SIGMA_MAX = 24.0
SIGMA_MAX_SHARE = 1.0 / 8.0
"""Maximum of sigma over the shorter side of the tile, so that a tile holds at least 8 x 8 features."""
SPACING_MIN = 2.0
"""Minimum distance of bubble sites, texels; closer ones are single texels, not discs."""
LACE_SIGMA_MIN = 4.0
"""Minimum sigma of ``lace``: with less, its finest cells would be narrower than two texels."""
ASPECT_MAX = 6.0
SEED_MAX = 2**32 - 1
TEXT_FORM = "family:sigma:size:seed (lace: also :aspect:age)"
"""Name of a custom mask; size is SIDE or WIDTHxHEIGHT."""
DEFAULT_SIGMA: dict[Family, float] = {"vac": 24.0, "blur": 6.0, "clump": 1.5, "bubble": 4.0, "mix": 4.0, "lace": 10.0}


_READING = "The paper's arrays were never published; this is our reading of its description."
FAMILY_TITLES: dict[Family, str] = {
    "vac": "Void and cluster",
    "blur": "Filtered white noise",
    "clump": "Clumps",
    "bubble": "Bubbles",
    "mix": "Clustered bubbles",
    "lace": "Lace",
}
FAMILY_SUMMARIES: dict[Family, str] = {
    "vac": f"Dots spread by void-and-cluster; a wider Gaussian lets them come closer and leave gaps. {_READING}",
    "blur": f"White noise filtered by a Gaussian: patches as wide as the filter. {_READING} Its spectra speak "
    "against this one, which is kept for comparison.",
    "clump": "Band-passed noise: irregular lace that magnifies smoothly. Not from the paper.",
    "bubble": "Unions of discs that shrink and go out as saturation falls. Not from the paper.",
    "mix": "Clusters of round bubbles with open water between; cover is patchy by design. Not from the paper.",
    "lace": "The walls of a foam of large and small cells: holes grow and merge as saturation falls, and threads of "
    "foam go last. Not from the paper.",
}


@dataclass(frozen=True, slots=True)
class MaskSpec:
    """Determine a mask, with :data:`GENERATOR` and a method. Create them with :func:`check_parameters`."""

    family: Family
    sigma: float
    width: int
    height: int
    seed: int
    aspect: float = 1.0
    """Length of cells along x over their width, 1..6; only ``lace`` takes another than 1."""
    age: float = 0.0
    """0, young foam, to 1, old and torn; only ``lace`` takes another than 0."""

    @property
    def text(self) -> str:
        """``family:sigma:size:seed``, for ``lace`` with ``:aspect:age``: the inverse of :func:`parse_parameters`."""
        own = f":{self.aspect:g}:{self.age:g}" if self.family == "lace" else ""
        return f"{self.family}:{self.sigma:g}:{self.size}:{self.seed}{own}"

    @property
    def size(self) -> str:
        """``SIDE`` of a square tile, ``WIDTHxHEIGHT`` of another: the inverse of :func:`parse_size`."""
        return f"{self.width}" if self.width == self.height else f"{self.width}x{self.height}"

    @property
    def shape(self) -> tuple[int, int]:
        """Rows and columns."""
        return self.height, self.width


def sigma_range(family: Family, side: int) -> tuple[float, float]:
    """Least and greatest ``sigma`` (texels) of a family on a tile whose shorter side is ``side`` texels."""
    least = LACE_SIGMA_MIN if family == "lace" else SPACING_MIN if family in ("bubble", "mix") else SIGMA_MIN
    return least, min(SIGMA_MAX, side * SIGMA_MAX_SHARE)


def check_parameters(
    family: str, sigma: float | None, size: int | tuple[int, int], seed: int, aspect: float = 1.0, age: float = 0.0
) -> MaskSpec:
    """Check a request and return it with its types settled.

    ``size`` is the side, or width and height. ``sigma=None`` takes the family's :data:`DEFAULT_SIGMA`, held to what
    the size allows. ``aspect`` (1..6) and ``age`` (0..1) are of ``lace`` alone.

    Raises ``ValueError`` naming the argument, its value and what is allowed.
    """
    if family not in FAMILIES:
        raise ValueError(f"family {family!r} is not one of {', '.join(FAMILIES)}")
    width, height = size if isinstance(size, tuple) else (size, size)
    for side in (width, height):
        if isinstance(side, bool) or not isinstance(side, int) or not SIDE_MIN <= side <= SIDE_MAX:
            raise ValueError(f"size {side!r} is not a whole number of texels in {SIDE_MIN}..{SIDE_MAX}")
    if isinstance(seed, bool) or not isinstance(seed, int) or not 0 <= seed <= SEED_MAX:
        raise ValueError(f"seed {seed!r} is not an integer in 0..{SEED_MAX}")
    least, greatest = sigma_range(family, min(width, height))
    chosen = min(DEFAULT_SIGMA[family], greatest) if sigma is None else float(sigma)
    if not (math.isfinite(chosen) and least <= chosen <= greatest):
        tile = f"{width} x {height} texels"
        raise ValueError(f"sigma {chosen!r} is outside {least:g}..{greatest:g} texels for {family} at {tile}")
    for name, value, low, high in (("aspect", aspect, 1.0, ASPECT_MAX), ("age", age, 0.0, 1.0)):
        if family != "lace":
            if value != low:
                raise ValueError(f"{name} {value!r} is allowed only for lace, not {family}")
        elif not (math.isfinite(value) and low <= value <= high):
            raise ValueError(f"{name} {value!r} is outside {low:g}..{high:g}")
    return MaskSpec(family, chosen, width, height, seed, float(aspect), float(age))


def parse_parameters(text: str) -> MaskSpec:
    """Parameters written ``family:sigma:size:seed``, for ``lace`` also ``family:sigma:size:seed:aspect:age``.

    Raises ``ValueError`` as :func:`check_parameters` does, and where the text has another form.
    """
    parts = text.split(":")
    if len(parts) not in (4, 6):
        raise ValueError(f"{text!r} is not of the form {TEXT_FORM}")
    family, sigma, size, seed, *lace = parts
    return check_parameters(family, float(sigma), parse_size(size), int(seed), *map(float, lace))


def parse_size(text: str) -> tuple[int, int]:
    """Width and height written ``SIDE`` or ``WIDTHxHEIGHT``. Raises ``ValueError`` for another form."""
    found = re.fullmatch(r"(\d{1,5})(?:x(\d{1,5}))?", text, re.ASCII)
    if found is None:
        raise ValueError(f"size {text!r} is not of the form SIDE or WIDTHxHEIGHT, {SIDE_MIN}..{SIDE_MAX} texels each")
    return int(found[1]), int(found[2] or found[1])
