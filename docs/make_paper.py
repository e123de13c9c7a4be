"""The tables of docs/paper.md: what Yingst, Alford and Parberry (2011) print, beside Seafoam's.

Run as ``python docs/make_paper.py``.
"""

import math
import re
from pathlib import Path

import numpy as np

from seafoam.masks.catalogue import mask_by_name
from seafoam.masks.judge.spectrum import measure_spectrum
from seafoam.reference.foam.front import front_saturation

DOCS = Path(__file__).parent
PAGE = DOCS / "paper.md"
MARK = re.compile(r"(<!-- paper: ([a-z ]+) -->\n).*?(<!-- end -->)", re.DOTALL)
PHASES = {"0.3": 0.3, "π/2": 0.5 * math.pi, "π": math.pi, "3π/2": 1.5 * math.pi, "2π − 0.3": 2.0 * math.pi - 0.3}
SIGMAS = ("1.5", "6", "24")
BANDS = ((0.0, 0.05), (0.05, 0.15), (0.15, 0.5))
"""Of frequencies, cycles per texel."""


def row(*cells: str) -> str:
    """A line of a table."""
    return f"| {' | '.join(cells)} |\n"


def ours(phase: float, base: float = math.e) -> float:
    """The float64 reference of one wave's front, C = 4."""
    return float(front_saturation(np.array([math.cos(phase)]), np.array([math.sin(phase)]), 4.0, base)[0])


def saturations() -> str:
    """Formula and listing as printed, and as Seafoam has them, which is at most 4."""
    table = row("θ", "text: printed", "ours", "listing: printed", "ours") + row(*5 * ("---",))
    for name, theta in PHASES.items():
        text = math.exp(-math.tan(0.5 * theta + 0.5 * math.pi)) / 4.0
        turned = theta * 6.28 / (2.0 * math.pi)
        code = 2.718 ** -math.tan(0.5 * turned + 1.07) / 4.0
        figures = (text, ours(theta), code, ours(turned + 2.14 - math.pi, 2.718))
        table += row(name, *(f"{figure:.4g}" for figure in figures))
    return table


def spectra() -> str:
    """Of each mask of figure 4 at grey 0.5: mean of the radially averaged power in three bands."""
    table = row("σ", *(f"{low:g} to {high:g} cycles a texel" for low, high in BANDS)) + row(*4 * ("---",))
    for sigma in SIGMAS:
        spectrum = measure_spectrum(mask_by_name(f"vac-{sigma}").ranks, greys=(0.5,))
        inside = [(spectrum.frequency > low) & (spectrum.frequency <= high) for low, high in BANDS]
        table += row(sigma, *(f"{spectrum.greys[0].raps[band].mean():.3g}" for band in inside))
    return table


def main() -> None:
    """Write the tables into the page."""
    tables = {"saturations": saturations, "spectra": spectra}
    page = PAGE.read_text(encoding="utf-8")
    PAGE.write_text(MARK.sub(lambda found: found[1] + tables[found[2]]() + found[3], page), encoding="utf-8")


if __name__ == "__main__":
    main()
