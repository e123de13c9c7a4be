"""Every guard of a hard case, taken out, is missed by the case's pictures."""

from pathlib import Path

import numpy as np
import pytest

from seafoam.effects.effect import Effect
from seafoam.render.gl.executor import Executor
from support.cases import HardCase
from support.hard.mutations import copied, run, source
from support.hard.pictures import CASES, HARD, judged, truth_of
from support.report import Report
from support.sweep import rested

TITLE = "Guards of hard cases taken out"


@pytest.mark.parametrize(("effect", "case"), rested(CASES, 21))
def test_a_guard_that_is_taken_out_is_missed(
    executor: Executor, tmp_path: Path, report: Report, effect: Effect, case: HardCase
) -> None:
    with copied(tmp_path / "mutated", case.without) as environment:
        file = tmp_path / "pictures.npz"
        assert run(environment, "-m", "support.hard.pictures", case.name, str(file)) is None
        with np.load(file) as pictures:
            found = judged(case, dict(pictures), truth_of(executor, case))
    assert found.faults, "the case's pictures are as they have to be without its guard"
    report.add(TITLE, effect=effect.name, case=case.name, seen=found.words)


def test_what_is_taken_out_is_in_the_sources() -> None:
    missing = []
    for _, case in HARD:
        assert case.without, case.name
        for name, texts in case.without.items():
            content = source(name).read_text(encoding="utf-8")
            missing += [(case.name, text) for text in texts if text not in content]
    assert missing == []


def test_the_copy_without_mutations_passes(executor: Executor, tmp_path: Path) -> None:
    case = CASES[0].values[1]
    with copied(tmp_path / "copy", {}) as environment:
        assert run(environment, "-m", "support.hard.pictures", case.name, str(tmp_path / "pictures.npz")) is None
        with np.load(tmp_path / "pictures.npz") as pictures:
            assert judged(case, dict(pictures), truth_of(executor, case)).faults == ()
