"""Writes the golden vectors that hold the foam chapter's formulas to the reference; run it as a script."""

import json
import math
from pathlib import Path

import numpy as np

from seafoam.masks.catalogue import mask_by_name
from seafoam.masks.formats import quantised
from seafoam.masks.judge.spectrum import measure_spectrum
from seafoam.reference import sampling
from seafoam.reference.foam import front, looks
from seafoam.reference.noise import pcg
from seafoam.reference.renderer.sources import height_saturation

PATH = Path(__file__).with_name("foam_strips.json")

SIDE = 32
SAMPLE = 0.5
"""Side of a sample, texels."""
SEED = 7
WHITE_SEED = 2011
WHITE_COUNT = 256
GREYS = (1 / 16, 1 / 4, 1 / 2)

Vectors = list[dict[str, object]]


def fronts() -> Vectors:
    """Saturations of fronts over a period, with the paper's constants and with others."""
    theta = np.linspace(0.03, 2.0 * math.pi - 0.03, 61)
    kinds = [(name, one.delta, one.base, 4.0) for name, one in front.FRONT_CONSTANTS.items()]
    kinds += [("other", 1.3, 2.2, 1.0), ("other", 2.0, 4.0, 30.0)]
    vectors: Vectors = []
    for name, delta, base, intensity in kinds:
        psi = theta + 2.0 * delta - math.pi
        f = front.front_saturation(np.cos(psi), np.sin(psi), intensity, base)
        vectors.append(
            {
                "constants": name,
                "delta": delta,
                "base": base,
                "intensity": intensity,
                "theta": theta.tolist(),
                "saturation": f.tolist(),
            }
        )
    return vectors


def amounts() -> Vectors:
    """Amounts of the looks that compare with single texels."""
    f, m, t = (one.ravel() for one in np.meshgrid([0.0, 0.1, 0.3, 0.7, 1.0, 2.2, 4.0], [0.05, 0.3, 0.9], [0.4, 1.0]))
    found = {
        "textured": looks.textured(f, t),
        "halftone": looks.halftone(f, m),
        "fading": looks.fading(f, m),
        "halftone_textured": looks.halftone_textured(f, m, t),
        "listing": looks.listing(f, m, t),
    }
    return [
        {"look": name, "f": f.tolist(), "m": m.tolist(), "t": t.tolist(), "amount": a.tolist()}
        for name, a in found.items()
    ]


def filtered(words: np.ndarray, quantiles: np.ndarray) -> Vectors:
    """Coverage of samples of half a texel, for saturations and fades."""
    values = (words + 0.5) / 65536.0
    random = np.random.default_rng(3)
    u, v = random.random(24), random.random(24)
    foot_u = np.tile([SAMPLE / SIDE, 0.0], (u.size, 1))
    foot_v = np.tile([0.0, SAMPLE / SIDE], (u.size, 1))
    size = np.full((u.size, 2), SAMPLE)
    b, e = looks.spline_over_footprint(sampling.bspline(values, u, v), foot_u, foot_v)
    vectors: Vectors = []
    for fade in (0.0, 0.2):
        for s in (0.0, 0.001, 0.08, 0.3, 0.6, 0.97, 1.0):
            share = np.full_like(u, s)
            threshold = sampling.quantile(quantiles, share)
            width = looks.spline_fade(quantiles, share, fade)
            near = looks.magnified_coverage(b, e, threshold, width)
            covered = looks.filtered_coverage(share, np.zeros_like(u), near, size, whole=fade == 0.0)
            vectors.append(
                {"s": s, "fade": fade, "x": (u * SIDE).tolist(), "y": (v * SIDE).tolist(), "coverage": covered.tolist()}
            )
    return vectors


def shuffled() -> list[int]:
    """The order of white noise: Fisher and Yates with one hash a place."""
    ranks = list(range(WHITE_COUNT))
    words = pcg(np.arange(WHITE_SEED, WHITE_SEED + WHITE_COUNT, dtype=np.uint64))
    for i in range(WHITE_COUNT - 1, 0, -1):
        j = (int(words[i]) * (i + 1)) >> 32
        ranks[i], ranks[j] = ranks[j], ranks[i]
    return ranks


def main() -> None:
    """Write the vectors."""
    mask = mask_by_name(f"vac:1.5:{SIDE}:{SEED}")
    words = quantised(mask.ranks, 16)
    heights = np.linspace(-0.2, 1.4, 9)
    spectra = measure_spectrum(mask.ranks, greys=GREYS)
    document = {
        "fronts": fronts(),
        "heights": {
            "height": heights.tolist(),
            "base": 0.3,
            "full": 0.9,
            "saturation": height_saturation(heights, 0.3, 0.9).tolist(),
        },
        "amounts": amounts(),
        "mask": {"size": SIDE, "words": words.ravel().tolist(), "quantiles": mask.filtering.quantiles[0].tolist()},
        "sample": SAMPLE,
        "filtered": filtered(words, mask.filtering.quantiles[0]),
        "spectra": [{"grey": one.grey, "raps": one.raps.tolist()} for one in spectra.greys],
        "white": {"seed": WHITE_SEED, "ranks": shuffled()},
    }
    PATH.write_text(json.dumps(document) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
