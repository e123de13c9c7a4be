"""Whitecap coverage of the open sea against the wind: table and plot of docs/whitecaps.md, ``CLAMPED`` of scene/sea.py.

Run as ``python docs/make_whitecaps.py [--derive]``; with ``--derive`` it prints what ``CLAMPED`` should be instead.
"""

import sys

import numpy as np

from seafoam.reference.sea import fold_saturation, sea_surface
from seafoam.scene import sea as model
from seafoam.scene.models import Foam, FoldSaturation, Scene, Sea

WINDS = (5.0, 7.5, 10.0, 12.5, 15.0, 17.5, 20.0)
SEEDS = (1, 2)
FETCH = 5e5
TEXELS = 256
POINTS = 100_000


def coverage(wind: float, seed: int, points: int = POINTS, texels: int = TEXELS) -> float:
    """Mean foam of a sea, over points spread over its largest tile: the covered share, as masks are rank-uniform."""
    foam = FoldSaturation()
    scene = Scene(sea=Sea(wind=wind, fetch=FETCH, seed=seed), foam=Foam(saturation=(foam,)))
    surface = sea_surface(scene, 100.0 * seed, (0.0, 0.0), texels)
    assert surface is not None
    random = np.random.default_rng(seed)
    x, z = random.uniform(0.0, 20.0 * surface.tiles[0].size, (2, points))
    return float(fold_saturation(scene, foam, surface, x, z).mean())


def measured() -> dict[float, float]:
    """Coverage at each wind, the mean of several seas."""
    return {wind: float(np.mean([coverage(wind, seed) for seed in SEEDS])) for wind in WINDS}


def derive() -> tuple[tuple[float, float], ...]:
    """``CLAMPED`` from seas drawn with it: what is wanted over what is drawn, until it stands still."""
    factors = dict.fromkeys(WINDS, 1.0)
    for _ in range(3):
        model.CLAMPED = tuple(factors.items())
        for wind, drawn in measured().items():
            factors[wind] *= model.whitecaps(wind) / drawn
        print({wind: round(factor, 3) for wind, factor in factors.items()}, file=sys.stderr)
    return tuple((wind, round(factor, 3)) for wind, factor in factors.items())
