"""What a sea costs at any picture size: instructions of passes into targets of fixed size, by a GPU's compiler."""

import json
from pathlib import Path

import pytest

from seafoam.framegraph.resources import FixedSize
from seafoam.planner import make_plan
from seafoam.quality import TIERS
from support.scenes import load_preset

FIGURES = json.loads((Path(__file__).parents[3] / "bench/compiler.json").read_text(encoding="utf-8"))["figures"]
BOUNDS = {
    ("storm", "fast"): 460,
    ("storm", "standard"): 1220,
    ("boat-in-storm", "fast"): 430,
    ("open-ocean", "fast"): 345,
    ("open-ocean", "standard"): 1110,
}
"""Millions. Before passes drew into layers: 1243, 1862, 1149, 784 and 1468, most of a moving `storm` without a GPU."""


@pytest.mark.parametrize(("preset", "tier"), BOUNDS)
def test_what_is_drawn_at_any_size_stays_cheap(preset: str, tier: str) -> None:
    plan = make_plan(load_preset(preset).scene.settled, TIERS[tier])
    total = 0
    for drawn in plan.passes:
        target = plan.targets.get(drawn.target)
        if drawn.when == "frame" and target is not None and isinstance(target.size, FixedSize):
            total += target.size.width * target.size.height * FIGURES[f"{preset} {tier} {drawn.program}"][0]
    assert total <= 1e6 * BOUNDS[preset, tier]
