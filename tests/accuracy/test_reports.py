"""The tiers lie on the measured front: the reports that are checked in, read again."""

import csv
from statistics import median

import pytest

from inputs import ROOT
from seafoam.accuracy.points import plan_sha256, points_of
from seafoam.accuracy.sweep import beating
from seafoam.quality import TIERS, Quality
from seafoam.scene.presets import load_preset, preset_names

REPORTS = ROOT / "docs/reports"
LEAST = 110
"""Of the tiers in the presets, so many are beaten by nothing that was measured."""
DECADES = 100.0
"""Times that the dearest tier takes of the cheapest, in the middle of the presets."""


@pytest.fixture(scope="module")
def reports() -> dict[str, dict[str, dict[str, str]]]:
    """By preset and point: the columns."""
    found = {}
    for path in REPORTS.glob("*.csv"):
        with path.open(encoding="utf-8", newline="") as file:
            found[path.stem] = {row["id"]: row for row in csv.DictReader(file)}
    return found


def test_reports_are_of_todays_qualities(reports: dict[str, dict[str, dict[str, str]]]) -> None:
    """A tier or a knob that changes is measured again: seafoam accuracy PRESET, see docs/reports/README.md."""
    assert sorted(reports) == sorted(preset_names())
    for name, rows in reports.items():
        points = {point.id: point.quality for point in points_of(load_preset(name).scene)}
        assert {id: Quality.model_validate_json(row["quality"]) for id, row in rows.items()} == points, name
        assert (REPORTS / f"{name}.html").exists()


def test_tiers_lie_on_the_front(reports: dict[str, dict[str, dict[str, str]]]) -> None:
    """Nothing that was measured is faster by more than the quartiles of both and as exact."""
    low, high = "time_low_ms", "time_high_ms"
    beaten = {}
    for name, rows in reports.items():
        scene = load_preset(name).scene
        by = beating({id: (float(row[low]), float(row[high]), float(row["rmse"])) for id, row in rows.items()})
        at = {point.plan: point.id for point in points_of(scene)}
        for tier, quality in TIERS.items():
            # Two tiers with the same plan are one point.
            if better := by[at[plan_sha256(scene, quality)]]:
                beaten[f"{name}, {tier}"] = better
    assert len(TIERS) * len(reports) - len(beaten) >= LEAST, beaten


def test_tiers_span_two_decades_of_time(reports: dict[str, dict[str, dict[str, str]]]) -> None:
    tiers = [[float(row["time_ms"]) for row in rows.values() if row["tier"]] for rows in reports.values()]
    assert median(max(times) / min(times) for times in tiers) >= DECADES
