"""Hard cases of every effect, and the qualities that they are drawn at."""

import pytest

from seafoam.effects import EFFECTS
from seafoam.quality import TIERS, SurfaceQuality
from support.cases import cases_of
from support.exact import EXACT, SQUARE

QUALITIES = {
    "exact": EXACT,
    "march": SQUARE.model_copy(update={"target": "RGBA32F"}),
    "mesh": TIERS["fast"].model_copy(
        update={"target": "RGBA32F", "pixel_width": 1, "surface": SurfaceQuality(method="mesh", cells=112, refine=2)}
    ),
}
HARD = [(effect, case) for effect in EFFECTS for case in cases_of(effect).hard]
CASES = [pytest.param(effect, case, id=f"{effect.name}: {case.name}") for effect, case in HARD]
