"""The tiers lie on the measured front of time against error: drawn anew from the figures in docs/reports."""

import csv
import json
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from statistics import median

import pytest

from seafoam.accuracy.fronts import beating
from seafoam.accuracy.points import plan_sha256, points_of
from seafoam.quality import TIERS
from seafoam.scene.models import Scene
from seafoam.scene.presets import load_preset, preset_names
from support.report import Report
from support.sweep import spread

REPORTS = Path(__file__).parents[3] / "docs" / "reports"
AGAIN = "measure anew, as docs/reports/README.md says"
UNMEASURED = ("boat_shadows", "land_octaves", "shadow_steps", "cloud_shadow_octaves", "foam_texture")
"""Quality parameters that were added since the reports were measured."""
UNBEATEN = 110
"""Of the 120 tiers of all presets, so many at least are beaten by no other quality."""
SPAN = 20.0
"""From the fastest tier to the slowest, times, in the middle of the presets."""


@dataclass(frozen=True)
class Measured:
    """A line of a report: times by round (ms), RMSE (levels), parameters that are not their defaults (JSON)."""

    rounds: tuple[float, ...]
    error: float
    quality: str


@cache
def measured(preset: str) -> dict[str, Measured]:
    """What the preset's report says, by point."""
    with (REPORTS / f"{preset}.csv").open(newline="") as file:
        return {
            row["id"]: Measured(
                rounds=tuple(float(value) for value in row["rounds_ms"].split()),
                error=float(row["rmse"]),
                quality=row["quality"],
            )
            for row in csv.DictReader(file)
        }


@cache
def scene_of(preset: str) -> Scene:
    """The scene that was measured: the preset's, or what it was before it was recomposed."""
    earlier = json.loads((REPORTS / "scenes.json").read_text(encoding="utf-8"))
    return Scene.model_validate(earlier[preset]) if preset in earlier else load_preset(preset).scene


def points_of_tiers(preset: str) -> dict[str, str]:
    """The point that stands for each tier: tiers of one plan are one point."""
    scene = scene_of(preset)
    by_plan = {plan_sha256(scene, quality): tier for tier, quality in TIERS.items() if tier in measured(preset)}
    return {tier: by_plan[plan_sha256(scene, quality)] for tier, quality in TIERS.items()}


def known(quality: str) -> dict[str, object]:
    """What differs from the defaults, without the parameters that were not measured."""
    return {name: value for name, value in json.loads(quality).items() if name not in UNMEASURED}


@pytest.mark.parametrize("preset", spread(preset_names(), 8, 4))
def test_a_report_is_of_todays_qualities(preset: str) -> None:
    today = {
        point.id: known(point.quality.model_dump_json(exclude_defaults=True))
        for point in points_of(scene_of(preset))
        if point.parameter is None or point.parameter.pointer.removeprefix("/") not in UNMEASURED
    }
    assert {id: known(one.quality) for id, one in measured(preset).items()} == today, AGAIN


def test_tiers_lie_on_the_front(report: Report) -> None:
    unbeaten = 0
    spans = []
    for preset in preset_names():
        found = measured(preset)
        tiers = points_of_tiers(preset)
        by = beating({id: (one.rounds, one.error) for id, one in found.items()})
        unbeaten += sum(not by[id] for id in tiers.values())
        times = [median(found[id].rounds) for id in tiers.values()]
        spans.append(max(times) / min(times))
        for tier, id in tiers.items():
            if by[id]:
                report.add("Tiers that another quality beats", preset=preset, tier=tier, by=by[id][0])
    whole = len(TIERS) * len(spans)
    report.add("Tiers on the front", unbeaten=f"{unbeaten}", of=f"{whole}", span=f"{median(spans):.0f}")
    assert unbeaten >= UNBEATEN
    assert median(spans) >= SPAN
