"""Sweeps with a renderer whose times and errors are known, and the parameters that they go through."""

import csv
import time
from pathlib import Path

import numpy as np
import pytest
from pydantic import BaseModel, ValidationError

from seafoam.accuracy import plots, report, sweep
from seafoam.accuracy.cache import cache_dir, stored
from seafoam.accuracy.model import Running, Sweep
from seafoam.accuracy.points import (
    SPINE_KNOBS,
    all_parameters,
    chains,
    every_parameter,
    idealised,
    points_of,
    value_at,
    with_value,
)
from seafoam.accuracy.sweep import Subject, SweepSettings, make_sweep
from seafoam.accuracy.sweep_service import FailedError, SweepService
from seafoam.accuracy.timing import beating, choose, front
from seafoam.accuracy.truth import SweepStoppedError, TruthSpec, Watcher, find_truth, make_truth
from seafoam.planner import make_plan
from seafoam.quality import TIERS, Quality
from seafoam.scene import Scene, load_preset, preset_names
from support.accuracy_rigs import FIXED_MS, NS, grey_truth, noisy
from support.sweep import spread

SETTINGS = SweepSettings(32, 18, 2, 3)


@pytest.fixture(scope="module")
def kept(tmp_path_factory):
    """Where the known sweep is kept."""
    return tmp_path_factory.mktemp("cache")


@pytest.fixture(scope="module")
def known(kept):
    """A sweep of the default preset by the noisy renderer."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(sweep, "make_truth", grey_truth)
        return make_sweep(stored(kept), Subject.of_preset("default"), SETTINGS, noisy())


def test_the_front_is_what_nothing_beats_in_both_beyond_the_noise():
    found = {"a": (1.0, 9.0), "b": (2.0, 9.0), "c": (2.0, 4.0), "d": (3.0, 5.0), "e": (9.0, 1.0), "f": (9.0, 2.0)}
    assert front(found) == ("a", "c", "e")
    assert front({}) == ()
    # Every round is slower than the one before: only times of one round are compared.
    found = {
        "a": ((1.0, 2.0, 4.0), 5.0),
        "b": ((1.5, 3.1, 6.2), 5.0),
        "c": ((1.4, 2.1, 4.1), 6.0),
        "d": ((9.0, 18.0, 36.0), 4.0),
        "e": ((8.5, 17.0, 34.5), 1.0),
        "f": ((7.0, 14.0, 39.0), 1.0),
    }
    assert beating(found) == {"a": (), "b": ("a",), "c": (), "d": (), "e": (), "f": ()}
    assert beating(found | {"g": ((10.0, 20.0, 40.0), 6.0)})["g"] == ("e", "f", "d", "a", "b", "c")


def test_times_and_their_model_are_of_a_size_that_shows_more_than_maps(known):
    point = known.point("samples=4")
    # Of frames as large as the preset's own, which were not drawn.
    assert (known.timing.own_width, known.timing.own_height) == (1280, 720)
    assert known.timing.width < 1280
    assert point.time.median_ms == pytest.approx(FIXED_MS + 4e-6 * NS * 1280 * 720)
    assert point.model.fixed_ms == pytest.approx(FIXED_MS, rel=1e-3)
    assert point.model.ns_per_pixel == pytest.approx(4 * NS, rel=1e-3)
    assert point.model.at(1280, 720) == pytest.approx(FIXED_MS + 4e-6 * NS * 1280 * 720, rel=1e-3)
    # Large enough that what a call costs does not hide what a pixel costs.
    timed = known.point("standard").model.at(known.timing.width, known.timing.height)
    assert timed >= 999.0 * sweep.ENOUGH_SECONDS
    assert sweep.LEAST_SHARE * known.timing.width >= 1280
    assert sweep.LEAST_SHARE * known.timing.height >= 720


def test_errors_and_their_causes(known):
    standard, four = known.point("standard"), known.point("samples=4")
    assert standard.error.rmse == pytest.approx(25.5, rel=0.1)
    assert four.error.rmse == pytest.approx(standard.error.rmse / 4, rel=1e-3)
    assert standard.causes.filtering == pytest.approx(standard.error.rmse * 24 / 25, rel=1e-3)
    assert standard.causes.geometry == standard.causes.precision == 0.0
    assert standard.causes.rest == pytest.approx(standard.error.rmse / 25, rel=1e-3)
    assert known.point("reference").causes.filtering == 0.0
    assert {point.causes is None for point in known.points if point.tier is None} == {True}


def test_what_it_says(known):
    assert [known.point(id).quality.samples for id in known.front] == [1, 4, 9, 16, 25]
    (step,) = [step for step in known.steps if (step.pointer, step.value_from) == ("/samples", 4)]
    assert step.value_to == 9
    fewer, more = (known.point(f"samples={count}") for count in (4, 9))
    removed, added = fewer.error.rmse - more.error.rmse, more.time.median_ms - fewer.time.median_ms
    assert step.error_per_ms == pytest.approx(removed / added, rel=0.05)
    assert "2.2× the time buys 2.2× less error" in step.sentence
    (same,) = [step for step in known.steps if step.pointer == "/target"]
    assert same.error_per_ms is None
    assert "no measurable difference in time and the same error" in same.sentence
    assert len(known.sentences) == 4


def test_rounds_turn(monkeypatch, tmp_path):
    monkeypatch.setattr(sweep, "make_truth", grey_truth)
    log = []
    make_sweep(stored(tmp_path), Subject(None, Scene(), 3.0, (32, 18)), SETTINGS, noisy(log))
    timed = [job for job in log if len(job.draws) == 4]
    # Nothing is timed, or compared, that has not been compiled by a draw just before.
    assert all((job.draws[0].width, job.draws[0].keep) == (job.draws[-1].width, False) for job in timed)
    points = {job.quality for job in timed}
    per_round = len(timed) // SETTINGS.rounds
    rounds = [timed[i : i + per_round] for i in range(0, len(timed), per_round)]
    assert all({job.quality for job in one} == points for one in rounds)
    assert len({tuple(job.quality for job in one) for one in rounds}) == len(rounds)
    assert [one[0].time for one in rounds] == pytest.approx([3.0, 3.0 + 1 / 60, 3.0 + 2 / 60])


def test_a_sweep_survives_json_and_is_found_again_unless_it_is_damaged(known, kept, monkeypatch, tmp_path):
    assert Sweep.model_validate_json(known.model_dump_json()) == known
    # A scene that is a preset's is the preset.
    assert Subject.of_scene(Subject.of_preset("shallows").scene) == Subject.of_preset("shallows")
    assert Subject.of_scene(Scene()).preset is None
    subject = Subject.of_preset("default")
    log = []
    assert make_sweep(stored(kept), subject, SETTINGS, noisy(log)) == known
    assert not log
    monkeypatch.setattr(sweep, "make_truth", grey_truth)
    make_sweep(stored(kept), subject, SETTINGS, noisy(log), again=True)
    assert log
    other = noisy(log).machine.model_copy(update={"renderer": "another"})
    assert sweep.find_sweep(stored(kept), subject, SETTINGS, other) is None
    assert sweep.find_sweep(stored(kept), subject, SweepSettings(32, 18, 2, 4), noisy().machine) is None
    (file,) = (kept / "accuracy").rglob("*.json")
    stored(tmp_path).put(file.name, b"{")
    assert sweep.find_sweep(stored(tmp_path), Subject.of_preset("default"), SETTINGS, noisy().machine) is None


def test_a_sweep_can_be_called_off(monkeypatch, tmp_path):
    monkeypatch.setattr(sweep, "make_truth", grey_truth)
    shares = []
    watcher = Watcher(lambda stage, share, remaining: shares.append(share), lambda: len(shares) > 10)
    with pytest.raises(SweepStoppedError):
        make_sweep(stored(tmp_path), Subject(None, Scene(), 0.0, (32, 18)), SETTINGS, noisy(), watcher)
    assert shares == sorted(shares)
    assert 0.3 <= shares[0] <= shares[-1] < 1.0


def test_reports_of_a_sweep(known):
    lines = list(csv.reader(report.csv_of(known).splitlines()))
    assert len(lines) == len(known.points) + 1
    assert {len(line) for line in lines} == {len(report.COLUMNS)}
    qualities = [line[report.COLUMNS.index("quality")] for line in lines[1:]]
    assert [Quality.model_validate_json(text) for text in qualities] == [point.quality for point in known.points]
    assert plots.plot_sweep(known).startswith(b"\x89PNG")
    page = report.page(known, "seafoam accuracy <default>")
    assert "seafoam accuracy &lt;default&gt;" in page
    assert "data:image/png;base64," in page
    assert "http" not in page
    assert known.sentences[0] in page


def test_a_budget_takes_the_least_error_that_fits_of_what_may_be_drawn_or_else_the_fastest(known):
    size = (160, 90)
    one = FIXED_MS + 1e-6 * NS * 160 * 90
    sixteen = FIXED_MS + 16e-6 * NS * 160 * 90
    assert choose(known, *size, one * 1.01).point.quality.samples == 1
    assert choose(known, *size, sixteen * 0.99).point.quality.samples == 9
    best = choose(known, *size, sixteen * 1.01)
    assert best.point.quality.samples == 16
    assert best.fits
    assert best.predicted_ms == pytest.approx(sixteen, rel=1e-2)
    assert "RMSE" in best.why
    assert best.why.isascii()
    assert choose(known, 1280, 720, sixteen * 1.01).point.quality.samples == 1
    found = choose(known, 160, 90, 0.001)
    assert not found.fits
    assert "none within budget" in found.why
    assert found.predicted_ms == min(point.model.at(160, 90) for point in known.points)
    found = choose(known, 160, 90, 1e6, lambda quality: quality.samples < 9)
    assert found.point.quality.samples == 4
    with pytest.raises(ValueError, match="no measured quality"):
        choose(known, 160, 90, 1e6, lambda quality: False)


def test_the_cache_is_where_the_system_keeps_caches(monkeypatch, tmp_path):
    monkeypatch.setenv("SEAFOAM_CACHE", str(tmp_path))
    assert cache_dir() == tmp_path
    monkeypatch.delenv("SEAFOAM_CACHE")
    monkeypatch.setenv("XDG_CACHE_HOME", "/x")
    assert str(cache_dir()) == "/x/seafoam"
    for ignored in ("relative", ""):  # as the XDG Base Directory Specification says
        monkeypatch.setenv("XDG_CACHE_HOME", ignored)
        assert cache_dir() == Path.home() / ".cache" / "seafoam"


def eventually(ask, seconds=20.0):
    until = time.monotonic() + seconds
    while isinstance(found := ask(), Running):
        assert time.monotonic() < until, found
        time.sleep(0.02)
    return found


def test_a_service_measures_one_after_the_other_tells_a_failure_once_and_tries_again(monkeypatch, tmp_path):
    monkeypatch.setattr(sweep, "make_truth", grey_truth)
    service = SweepService(stored(tmp_path), SETTINGS, noisy)
    first, second = (Subject(None, Scene(), at, (32, 18)) for at in (0.0, 1.0))
    assert service.sweep(first).status in ("queued", "running")
    assert service.sweep(second).status == "queued"
    assert eventually(lambda: service.sweep(second)).time == 1.0
    assert isinstance(service.sweep(first), Sweep)

    def fail(*_, **__):
        raise OSError("disk on fire")

    monkeypatch.setattr(sweep, "make_truth", fail)
    subject = Subject(None, Scene(), 2.0, (32, 18))
    with pytest.raises(FailedError, match="disk on fire"):
        eventually(lambda: service.sweep(subject))
    monkeypatch.setattr(sweep, "make_truth", grey_truth)
    assert isinstance(eventually(lambda: service.sweep(subject)), Sweep)
    service.stop()
    (tmp_path / "file").write_text("")
    service = SweepService(stored(tmp_path / "file"), SETTINGS, noisy)
    with pytest.raises(FailedError, match="file/accuracy cannot be written"):
        eventually(lambda: service.sweep(subject))
    service.stop()


def test_truth_is_computed_once(tmp_path):
    store, spec = stored(tmp_path), TruthSpec(Scene(), 0.0, 16, 16, 2)
    assert find_truth(store, spec) is None
    truth = make_truth(store, spec, noisy().measure)
    assert (truth.shape, truth.dtype) == ((16, 16, 4), np.dtype(np.float32))
    assert truth[..., :3].std() > 0.01
    np.testing.assert_array_equal(find_truth(store, spec), truth)
    with pytest.raises(SweepStoppedError):
        make_truth(store, TruthSpec(Scene(), 1.0, 640, 640, 16), noisy().measure, Watcher(stopped=lambda: True))


def fields(model: type[BaseModel], path: str = "") -> list[str]:
    found = []
    for name, info in model.model_fields.items():
        inner = info.annotation
        nested = isinstance(inner, type) and issubclass(inner, BaseModel)
        found += fields(inner, f"{path}/{name}") if nested else [f"{path}/{name}"]
    return found


def test_every_field_of_quality_is_covered_by_one_parameter_and_bad_values_are_refused():
    pointers = [parameter.pointer for _, parameter in every_parameter()]
    assert sorted(pointers) == sorted(fields(Quality))
    for pointer in ("/surface/steps", "/surface/nope"):
        with pytest.raises(ValidationError):
            with_value(TIERS["standard"], pointer, 0)


@pytest.mark.parametrize(
    "parameter", [parameter for _, parameter in every_parameter()], ids=lambda parameter: parameter.pointer
)
def test_steps_are_valid_qualities(parameter):
    made = [with_value(TIERS["standard"], parameter.pointer, step) for step in parameter.steps]
    assert len(set(made)) == len(made) >= 2
    assert [value_at(one, parameter.pointer) for one in made] == list(parameter.steps)
    assert TIERS["standard"] in made
    assert parameter.title


def test_effects_that_do_not_run_bring_no_parameters_and_no_points():
    assert {owner for owner, _ in all_parameters(Scene())} == {"frame"}
    assert len(all_parameters(Scene())) == len(SPINE_KNOBS)
    assert {owner for owner, _ in all_parameters(load_preset("default").scene)} > {"frame", "ripples", "foam look"}
    assert not [point for point in points_of(Scene()) if point.parameter and point.parameter.owner == "ripples"]


# That of the known sweep and of test_reports.py, which make the same plans: each preset has a hundred.
@pytest.mark.parametrize("preset", spread(preset_names(), len(preset_names()), preset_names().index("default")))
def test_points_have_plans_of_their_own(preset):
    scene = load_preset(preset).scene
    points = points_of(scene)
    # On level water without ripples, from straight above, tier fast has nothing to leave out.
    tiers = [point.tier for point in points if point.tier]
    assert tiers == [tier for tier in TIERS if tier in tiers]
    assert len(tiers) == (3 if preset == "paper-threshold" else 4)
    assert len({point.plan for point in points}) == len({point.id for point in points}) == len(points) > 6
    assert points[-1].plan == make_plan(scene, points[-1].quality).sha256
    for point in points:
        if point.parameter:
            assert point.quality == with_value(TIERS["standard"], point.parameter.pointer, point.parameter.value)
    names = {point.id for point in points}
    links = chains(scene, points)
    assert len(links) > 3
    for before, after, first, second in links:
        assert {first, second} <= names
        assert before.pointer == after.pointer
        assert first != second


def test_idealising_one_cause_leaves_the_others():
    made = idealised(TIERS["fast"], "filtering")
    assert made.samples == TIERS["reference"].samples
    assert made.surface.filter is TIERS["reference"].surface.filter
    assert made.surface.tolerance == TIERS["fast"].surface.tolerance
    assert made.target == TIERS["fast"].target
    for cause in ("geometry", "filtering", "precision"):
        made = idealised(made, cause)
    ideal = make_plan(load_preset("default").scene, made).sha256
    assert ideal == make_plan(load_preset("default").scene, TIERS["reference"]).sha256
