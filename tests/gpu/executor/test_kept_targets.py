"""Passes that are drawn once: how often they are drawn, and what of them is kept."""

from collections.abc import Callable

import pytest

from seafoam.planner import FramePlan, make_plan
from seafoam.quality import TIERS
from seafoam.render.gl.executor import Executor, ShaderError
from seafoam.render.gl.formats import target_bytes
from support.pictures import draw
from support.scenes import load_preset, preset_names

STANDARD = TIERS["standard"]
SHORES = [name for name in preset_names() if load_preset(name).scene.shore is not None]


@pytest.fixture
def fresh(executor: Executor) -> Executor:
    """The executor with nothing kept."""
    executor._static.clear()
    return executor


@pytest.fixture
def drawn(fresh: Executor, monkeypatch: pytest.MonkeyPatch) -> Callable[[FramePlan], list[str]]:
    """Draws a frame and gives the names of its passes."""
    names: list[str] = []
    draw_pass = fresh._draw

    def counted(plan: FramePlan, index: int, *rest: object) -> None:
        names.append(plan.passes[index].name)
        draw_pass(plan, index, *rest)

    monkeypatch.setattr(fresh, "_draw", counted)
    times = iter(range(100))

    def frame(plan: FramePlan) -> list[str]:
        names.clear()
        camera = load_preset("island-surf").scene.camera
        draw(fresh, plan, camera, time=float(next(times)), size=(16, 9))
        return list(names)

    return frame


def shore_passes(names: list[str]) -> int:
    return sum(name.startswith("shore: ") for name in names)


def mask_passes(names: list[str]) -> int:
    return sum(name.startswith("mask: ") for name in names)


class TestDraws:
    def test_setup_passes_are_drawn_for_the_first_frame_alone(self, drawn: Callable[[FramePlan], list[str]]) -> None:
        plan = make_plan(load_preset("island-surf").scene, STANDARD)
        first, second, third = (drawn(plan) for _ in range(3))
        assert (shore_passes(first), shore_passes(second)) == (16, 1)
        # Eleven for each of two masks, and one that lays them over one another.
        assert (mask_passes(first), mask_passes(second)) == (23, 0)
        still = {one.name for one in plan.passes if one.when == "setup"}
        assert second == third == [name for name in first if name not in still]

    def test_another_plan_of_the_same_shore_draws_no_map_of_its_own(
        self, drawn: Callable[[FramePlan], list[str]]
    ) -> None:
        scene = load_preset("island-surf").scene
        drawn(make_plan(scene, STANDARD))
        painted = scene.model_copy(update={"shore": scene.shore.model_copy(update={"rock": (0.2, 0.1, 0.1)})})
        assert shore_passes(drawn(make_plan(painted, STANDARD))) == 1
        smoother = scene.model_copy(update={"shore": scene.shore.model_copy(update={"smoothing": 9.0})})
        assert shore_passes(drawn(make_plan(smoother, STANDARD))) == 14
        assert shore_passes(drawn(make_plan(scene, STANDARD))) == 1

    def test_what_is_kept_is_bounded_in_bytes(
        self, fresh: Executor, drawn: Callable[[FramePlan], list[str]], monkeypatch: pytest.MonkeyPatch
    ) -> None:
        plan = make_plan(load_preset("island-surf").scene, STANDARD)
        drawn(plan)
        sizes = [target_bytes(target) for target in fresh._static._items.values()]
        assert sorted(sizes) == [256 * 128 * 8, 256 * 256 * 16, 1280 * 1024 * 8]
        monkeypatch.setattr(fresh._static, "_size", sum(sizes) - 1)
        drawn(plan)
        assert len(fresh._static._items) == 2
        monkeypatch.setattr(fresh._static, "_size", 0)
        drawn(plan)
        again = drawn(plan)
        assert (shore_passes(again), mask_passes(again)) == (16, 23)

    def test_a_target_whose_passes_failed_is_not_kept(self, fresh: Executor) -> None:
        scene = load_preset("island-surf").scene
        plan = make_plan(scene, STANDARD)
        broken = plan.programs["shore_blur"]
        fragment = broken.fragment.model_copy(update={"text": "#version 300 es\nbroken", "sha256": "0" * 64})
        programs = {**plan.programs, "shore_blur": broken.model_copy(update={"fragment": fragment})}
        with pytest.raises(ShaderError):
            draw(fresh, plan.model_copy(update={"programs": programs}), scene.camera, time=0.0, size=(16, 9))
        assert not fresh._static._items


@pytest.mark.parametrize("preset", ["island-surf", "drift-vortices"])
def test_a_frame_after_others_is_that_of_a_fresh_executor(preset: str, fresh: Executor) -> None:
    scene = load_preset(preset).scene
    plan = make_plan(scene, STANDARD)

    def at(time: float, one: FramePlan = plan) -> bytes:
        return draw(fresh, one, scene.camera, time=time, size=(48, 27)).tobytes()

    alone = at(7.3)
    fresh._static.clear()
    for other in SHORES[:2]:
        at(1.0, make_plan(load_preset(other).scene, STANDARD))
    at(2.0)
    assert at(7.3) == alone
    # And as it was where every pass is drawn in every frame.
    each = tuple(one.model_copy(update={"when": "frame"}) for one in plan.passes)
    assert at(7.3, plan.model_copy(update={"passes": each, "kept": {}})) == alone
