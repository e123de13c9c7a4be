"""Whitecap coverage of the open sea against the wind: table and plot of docs/whitecaps.md, factors of scene/sea.py.

Run as ``python docs/make_whitecaps.py [--derive]``; with ``--derive`` it prints what
``CLAMPED`` and ``LASTING_CLAMPED`` should be instead.
"""

import argparse
import sys
from pathlib import Path
from typing import Literal

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from seafoam.reference.sea import fold_saturation, sea_surface
from seafoam.scene import sea as model
from seafoam.scene.models import Foam, FoldSaturation, Scene, Sea

PAGE = Path(__file__).parent / "whitecaps.md"
PICTURE = Path(__file__).parent / "pictures" / "whitecaps.png"
MARK = "<!-- table -->\n"
WINDS = (5.0, 7.5, 10.0, 12.5, 15.0, 17.5, 20.0)
DERIVED, SHOWN = (1, 2), (5, 6)
"""Seeds of the seas that the factors come from, and of others that the page shows."""
FETCH = 5e5
LASTING_DECAY = 3.7
"""To 1/e, s: whitecaps of the open sea fade in 3.5 to 4 s (Monahan and Zietlow 1969)."""
TEXELS = 256
POINTS = 100_000


def coverage(wind: float, seed: int, kind: Literal["fft", "gerstner"] = "fft", lasting: bool = False) -> float:
    """Mean foam of a sea, over points spread over its largest tile: the covered share, as masks are rank-uniform."""
    foam = FoldSaturation(lasting=True, decay=LASTING_DECAY) if lasting else FoldSaturation()
    scene = Scene(sea=Sea(model=kind, wind=wind, fetch=FETCH, seed=seed), foam=Foam(saturation=(foam,)))
    # Where foam lasts, texels of its maps are those of the finest tiers.
    surface = sea_surface(scene, 100.0 * seed, (0.0, 0.0), 2 * TEXELS if lasting else TEXELS)
    assert surface is not None
    random = np.random.default_rng(seed)
    x, z = random.uniform(0.0, 20.0 * surface.tiles[0].size, (2, POINTS))
    return float(fold_saturation(scene, foam, surface, x, z).mean())


def measured(
    seeds: tuple[int, ...], kind: Literal["fft", "gerstner"] = "fft", lasting: bool = False
) -> dict[float, float]:
    """Coverage at each wind, the mean of several seas."""
    return {wind: float(np.mean([coverage(wind, seed, kind, lasting) for seed in seeds])) for wind in WINDS}


def derive(lasting: bool) -> tuple[tuple[float, float], ...]:
    """``CLAMPED`` from seas drawn with it: what is wanted over what is drawn, until it stands still."""
    factors = dict.fromkeys(WINDS, 1.0)
    for _ in range(3):
        if lasting:
            model.LASTING_CLAMPED = tuple(factors.items())
        else:
            model.CLAMPED = tuple(factors.items())
        for wind, drawn in measured(DERIVED, lasting=lasting).items():
            factors[wind] *= model.whitecaps(wind) / drawn
        print({wind: round(factor, 3) for wind, factor in factors.items()}, file=sys.stderr)
    return tuple((wind, round(factor, 3)) for wind, factor in factors.items())


def write(drawn: dict[float, float], gerstner: dict[float, float]) -> None:
    """The page's table and its plot."""
    rows = [
        "| wind, m/s | wanted, % | `fft`, % | over wanted | `gerstner`, % | over wanted |\n",
        "|---|---|---|---|---|---|\n",
    ]
    for wind in WINDS:
        wanted = model.whitecaps(wind)
        shares = " | ".join(f"{100 * of[wind]:.3f} | {of[wind] / wanted:.2f}" for of in (drawn, gerstner))
        rows.append(f"| {wind:g} | {100 * wanted:.3f} | {shares} |\n")
    before, _, after = PAGE.read_text(encoding="utf-8").split(MARK)
    PAGE.write_text(before + MARK + "".join(rows) + MARK + after, encoding="utf-8")
    figure = Figure(figsize=(8.0, 5.0), dpi=120, layout="constrained")
    FigureCanvasAgg(figure)
    axes = figure.subplots()
    winds = np.linspace(4.5, 21.0, 100)
    law = 100 * 3.84e-6 * winds**3.41
    axes.fill_between(winds, 0.8 * law, 1.2 * law, color="#dde3e6", label="within 20 %")
    axes.plot(winds, law, color="#1c2b33", lw=1.2, label="3.84e-6 U^3.41 (Monahan and O'Muircheartaigh 1980)")
    for of, mark, colour, name in ((drawn, "o", "#b5353c", "fft"), (gerstner, "^", "#27708b", "gerstner")):
        axes.plot(list(of), [100 * share for share in of.values()], mark, color=colour, label=f"drawn, {name}")
    axes.set_yscale("log")
    axes.set_xlabel("wind 10 m above the sea, m/s")
    axes.set_ylabel("share of the sea under foam, %")
    axes.legend(frameon=False)
    axes.grid(color="#dde3e6", lw=0.6)
    figure.savefig(PICTURE)


def main() -> None:
    """Write page and plot, or print ``CLAMPED``."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--derive", action="store_true")
    if parser.parse_args().derive:
        for lasting in (False, True):
            print("LASTING_CLAMPED" if lasting else "CLAMPED", derive(lasting))
    else:
        write(measured(SHOWN), measured(SHOWN, "gerstner"))


if __name__ == "__main__":
    main()
