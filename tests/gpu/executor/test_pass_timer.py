"""Timer queries of ``bench.gpu`` on a real context: every pass has one, and a frame is the same with them."""

from bench.drawn.passes import kind
from bench.gpu.timers import PassTimer, loads

from seafoam.planner import make_plan
from seafoam.quality import TIERS
from seafoam.render.gl.executor import Executor
from support.pictures import draw
from support.scenes import load_preset

SIZE = (64, 36)


def test_every_pass_of_a_frame_is_timed_and_the_picture_stays(executor: Executor) -> None:
    found = load_preset("open-ocean")
    plan, camera = make_plan(found.scene, TIERS["fast"]), found.scene.camera
    # Draws what is kept.
    plain = draw(executor, plan, camera, time=found.time, size=SIZE)
    timer = PassTimer(executor)
    for _ in range(2):
        with timer.running():
            assert (draw(executor, plan, camera, time=found.time, size=SIZE) == plain).all()
        taken = timer.seconds()
        assert taken["surface"] > 0.0
        assert taken.keys() <= {kind(one.name) for one in plan.passes if one.when == "frame"}
    assert 1 < len(timer._queries) <= sum(one.when == "frame" for one in plan.passes)


def test_known_loads_leave_the_context_as_it_was(executor: Executor) -> None:
    found = load_preset("paper-height")
    plan, camera = make_plan(found.scene, TIERS["fast"]), found.scene.camera
    before = draw(executor, plan, camera, time=found.time, size=SIZE)
    pairs = loads(executor)
    assert len(pairs) == 2
    assert all(wall > 0.0 for _, wall in pairs)
    assert (draw(executor, plan, camera, time=found.time, size=SIZE) == before).all()
