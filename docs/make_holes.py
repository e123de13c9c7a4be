"""Sizes of the holes in the foam of lace masks: table and plot of docs/masks.md.

Run as ``python docs/make_holes.py``.
"""

import io
from pathlib import Path

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from numpy.typing import NDArray
from PIL import Image
from rich.progress import track

from seafoam.masks.catalogue import mask_by_name
from seafoam.masks.judge.morphology import hole_areas

PAGE = Path(__file__).parent / "masks.md"
PICTURE = Path(__file__).parent / "pictures" / "mask-holes.webp"
MARK = "<!-- holes -->\n"
MASKS = ("lace", "lacetorn", "bubble")
SATURATIONS = (0.7, 0.5)
LEAST = 4
"""Smallest hole that is counted, texels: smaller ones have no shape."""
LARGE = 0.5
"""Quantile of the sizes above which holes determine the slope."""
BUBBLES = 10.0 / 3.0
"""Exponent of the density of radii of bubbles over 1 mm (Deane and Stokes 2002)."""


def measured(name: str, saturation: float) -> NDArray[np.float64]:
    """Areas of the holes, texels, the smallest first."""
    areas = hole_areas(mask_by_name(name).ranks, saturation).astype(np.float64)
    return areas[areas >= LEAST]


def slope(areas: NDArray[np.float64]) -> float:
    """Exponent n of the density of radii, p(r) ∝ r^−n, of the larger holes, by maximum likelihood (Hill)."""
    large = np.sqrt(areas[int(LARGE * len(areas)) :])
    return 1.0 + 1.0 / float(np.log(large / large[0]).mean())


def main() -> None:
    """Measure, and write table and plot."""
    rows = [
        "| mask | saturation | holes | diameters, texels | mean square area over square of the mean "
        "| slope of radii, larger half (bubbles: 3.3) |\n",
        "|---|---|---|---|---|---|\n",
    ]
    figure = Figure(figsize=(8.0, 4.6), dpi=100, layout="constrained")
    FigureCanvasAgg(figure)
    axes = figure.subplots()
    for name in track(MASKS, description="holes"):
        for saturation in SATURATIONS:
            areas = measured(name, saturation)
            sizes = np.sqrt(4.0 * areas / np.pi)
            moment = float(np.mean(areas**2) / np.mean(areas) ** 2)
            rows.append(
                f"| {name} | {saturation:g} | {len(areas)} | {sizes[0]:.0f} to {sizes[-1]:.0f} | {moment:.1f} "
                f"| {slope(areas):.1f} |\n"
            )
            share = 1.0 - np.arange(len(sizes)) / len(sizes)
            axes.loglog(sizes, share, "-" if saturation == SATURATIONS[0] else "--", label=f"{name}, {saturation:g}")
    guide = np.array([10.0, 100.0])
    axes.loglog(guide, (guide / guide[0]) ** (1.0 - BUBBLES), ":", color="#1c2b33", label="bubbles: r^(−10/3)")
    axes.set_xlabel("diameter of a hole, texels")
    axes.set_ylabel("share of holes at least as large")
    axes.legend(frameon=False)
    axes.grid(color="#dde3e6", lw=0.6)
    buffer = io.BytesIO()
    figure.savefig(buffer, format="png")
    Image.open(buffer).convert("RGB").save(PICTURE, quality=85, method=6)
    before, _, after = PAGE.read_text(encoding="utf-8").split(MARK)
    PAGE.write_text(before + MARK + "".join(rows) + MARK + after, encoding="utf-8")


if __name__ == "__main__":
    main()
