"""Hard cases of every effect, their pictures, and what is wrong with them.

Run as a module, it draws a case by what is on its path.
"""

import sys
from collections.abc import Collection, Mapping
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from seafoam.accuracy.truth import sprayed
from seafoam.effects import EFFECTS
from seafoam.quality import TIERS, SurfaceQuality
from seafoam.reference import render as reference
from seafoam.render.gl.executor import Executor
from seafoam.render.service.jobs import measure
from support.cases import HardCase, cases_of
from support.exact import EXACT, SQUARE
from support.pictures import levels, samples

HARD = [(effect, case) for effect in EFFECTS for case in cases_of(effect).hard]
CASES = [pytest.param(effect, case, id=f"{effect.name}: {case.name}") for effect, case in HARD]
QUALITIES = {
    "exact": EXACT,
    "march": SQUARE.model_copy(update={"target": "RGBA32F"}),
    "mesh": TIERS["fast"].model_copy(
        update={"target": "RGBA32F", "pixel_width": 1, "surface": SurfaceQuality(method="mesh", cells=112, refine=2)}
    ),
}
SIZE = (48, 27)
SHARE = 0.01
"""Of pixels off by more than 2 levels of linear light, between two qualities."""
HALF = "half"
"""The usual target, at the last time: bright suns are not infinite there, nights not lost."""

Pixels = NDArray[np.float32]
BY_NAME = {case.name: case for _, case in HARD}


def pictures_of(
    executor: Executor, case: HardCase, names: Collection[str] = (*QUALITIES, HALF), size: tuple[int, int] = SIZE
) -> dict[str, Pixels]:
    """A case's pictures by quality and number of the time."""
    found = {
        f"{name} {i}": samples(executor, case.scene, quality, case.camera, time=time, size=size)
        for i, time in enumerate(case.times)
        for name, quality in QUALITIES.items()
        if name in names
    }
    if HALF in names:
        found[HALF] = samples(executor, case.scene, SQUARE, case.camera, time=case.times[-1], size=size)
    return found


def truth_of(executor: Executor, case: HardCase) -> list[NDArray[np.float64]]:
    """The float64 reference's pictures of a case at its times."""
    truth = []
    for time in case.times:
        scene = sprayed(partial(measure, executor), case.scene, time, case.camera)
        truth.append(reference(scene, time=time, width=SIZE[0], height=SIZE[1], camera=case.camera).rgb)
    assert all(np.isfinite(picture).all() for picture in truth)
    return truth


@dataclass(frozen=True)
class Judged:
    """``mean``, ``share``: the worst of a case's times against the reference; ``faults``: what is wrong, in words."""

    mean: float
    share: float
    faults: tuple[str, ...]

    @property
    def words(self) -> str:
        """The faults of all pictures, each once."""
        return ", ".join(dict.fromkeys(fault.rpartition(": ")[2] for fault in self.faults))


def judged(case: HardCase, pictures: Mapping[str, Pixels], truth: list[NDArray[np.float64]]) -> Judged:
    """Compare a case's pictures with what they have to be: sound, near the reference, and as good in half floats."""
    faults = [f"{name}: {fault}" for name, picture in pictures.items() for fault in unsound(picture)]
    mean, share = 0.0, 0.0
    for i, true in enumerate(truth):
        away = levels(pictures[f"exact {i}"], true)
        mean, share = max(mean, float(away.mean())), max(share, float((away > 2.0).mean()))
    if not mean <= case.bounds.mean or not share <= case.bounds.share:
        faults.append(f"{mean:.2f} levels from the reference, {100.0 * share:.1f} % of samples off by more than 2")
    if HALF in pictures:
        away = levels(pictures[HALF], pictures[f"march {len(case.times) - 1}"])
        # Half floats keep 11 bits: an eighth of a level at white. The mask's moments and the ripple tile are the same.
        if not away.mean() <= 0.25 or not (away > 2.0).mean() <= SHARE:
            faults.append(f"half floats {away.mean():.2f} levels from float32")
    return Judged(mean, share, tuple(faults))


def unsound(pixels: Pixels) -> list[str]:
    """What no picture may have."""
    wrong = {
        "not finite": ~np.isfinite(pixels),
        "negative": pixels < 0.0,
        "a foam amount over 1": pixels[..., 3] > 1.0,
        "more light than half floats hold": pixels > 65504.0,
    }
    return [what for what, where in wrong.items() if where.any()]


def main(name: str, file: Path, *size: str) -> None:
    """Draw the case of a name and save its pictures: for a process whose package has a guard taken out."""
    executor = Executor()
    width, height = map(int, size or SIZE)
    np.savez(file, allow_pickle=False, **pictures_of(executor, BY_NAME[name], size=(width, height)))
    executor.close()


if __name__ == "__main__":
    main(sys.argv[1], Path(sys.argv[2]), *sys.argv[3:])
