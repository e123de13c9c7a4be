"""The bench's own arithmetic, and what its tables are made of."""

import math

import pytest
from bench.frames import Cost
from bench.report import Column, Table
from bench.steps import counting_shader
from bench.water_page import Frames
from bench.yardstick import GROUPS, Measured

from seafoam.plan import make_plan
from seafoam.plan.model import Shader
from seafoam.quality import TIERS
from seafoam.scene.models import Scene
from seafoam.scene.presets import preset_names


def _cost(*seconds: float) -> list[Cost]:
    return [Cost(wall=one, cpu=2.0 * one) for one in seconds]


def _three(*seconds: float, cpu: float) -> Frames:
    return Frames(wall=seconds, cpu=cpu)


def test_a_round_is_held_against_three_js_before_and_after_it() -> None:
    measured = Measured()
    measured.add(_cost(0.3, 0.2, 0.4), [_three(0.1, 0.1, cpu=0.1), _three(0.3, 0.3, 0.3, cpu=0.5)])
    measured.add(_cost(0.5), [_three(0.5, cpu=0.25), _three(0.5, cpu=0.25)])
    assert measured.wall == pytest.approx([1.0, 1.0])
    assert measured.cpu == pytest.approx([0.6 / 0.3, 1.0 / 0.25])
    assert measured.frames == pytest.approx([1.0, 2.0 / 3.0, 4.0 / 3.0, 1.0])
    assert measured.seconds == pytest.approx(0.35)
    assert measured.three_seconds == pytest.approx(0.4)


def test_every_preset_but_the_mask_alone_is_in_one_group_of_the_yardstick() -> None:
    grouped = [name for group in GROUPS for name in group.presets]
    assert sorted([*grouped, "paper-threshold"]) == sorted(preset_names())
    assert all(1.0 < group.aim < group.must for group in GROUPS)


def test_a_text_without_one_main_function_is_not_counted() -> None:
    shader = make_plan(Scene(), TIERS["standard"]).programs["surface"].fragment
    for text in (shader.text.replace("void main() {", "void other() {"), shader.text * 2):
        with pytest.raises(RuntimeError, match="main functions"):
            counting_shader(shader.model_copy(update={"text": text}))


def test_a_text_without_waves_is_not_counted() -> None:
    with pytest.raises(RuntimeError, match="no function that evaluates the waves"):
        counting_shader(Shader(text="void main() {\n}\n", sha256="", files=()))


def test_notes_of_tables_are_wrapped_and_columns_lined_up() -> None:
    table = Table(
        "Title", "word " * 50, (Column("a", "first"), Column("b", "second", "{:.1f}".format)), [("x", math.pi)]
    )
    lines = table.text().splitlines()
    assert max(map(len, lines)) <= 116
    assert lines[-3:] == ["first  second", "-----  ------", "x         3.1"]
