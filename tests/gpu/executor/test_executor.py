"""The executor's caches: what is let go is made again, and nothing of it is left in use."""

from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

from seafoam.framegraph.shader import Shader
from seafoam.planner import FramePlan, make_plan
from seafoam.quality import TIERS, SurfaceQuality
from seafoam.render.gl.executor import Executor, ShaderError
from support.pictures import ROUNDED, draw
from support.scenes import load_preset


def test_programs_let_go_and_made_again_draw_the_same(executor: Executor, monkeypatch: pytest.MonkeyPatch) -> None:
    """GL hands the numbers of released programs to new ones: an array kept by number would feed the wrong program."""
    monkeypatch.setattr(executor._programs, "_size", 2)
    scene = load_preset("default").scene
    qualities = [
        TIERS["standard"].model_copy(update={"surface": SurfaceQuality(method="mesh", cells=8 + i, steps=64 + i)})
        for i in range(5)
    ]
    plans = [make_plan(scene, quality) for quality in qualities] + [make_plan(scene, TIERS["standard"])]

    def drawn(plan: FramePlan) -> bytes:
        return draw(executor, plan, scene.camera, time=1.0, size=(32, 18)).tobytes()

    first = [drawn(plan) for plan in plans]
    assert [drawn(plan) for plan in plans] == first
    assert len(executor._programs._items) <= 2


def test_all_let_go_and_made_again_draws_the_same(executor: Executor) -> None:
    """moderngl binds the last framebuffer again whenever it makes an object: it must not be one that was released."""
    scene = load_preset("island-surf").scene
    plan = make_plan(scene, TIERS["fast"])

    def drawn() -> bytes:
        return draw(executor, plan, scene.camera, time=1.0, size=(32, 18)).tobytes()

    first = drawn()
    executor.forget()
    assert drawn() == first


def test_16_bits_are_the_8_bits_before_they_are_rounded(executor: Executor) -> None:
    preset = load_preset("default")
    plan = make_plan(preset.scene, TIERS["fast"])
    asked = {"time": preset.time, "camera": preset.scene.camera, "width": 96, "height": 54}
    exact = executor.render(plan, output="rgba8", **asked).pixels
    fine = executor.render(plan, output="rgba16", **asked).pixels
    assert fine.dtype == np.uint16
    # And the last of the 16 bits.
    assert np.abs(fine / 257.0 - exact).max() <= ROUNDED + 1 / 257
    assert (executor.render(plan, output="rgba8", **asked).pixels == exact).all()


def test_a_shader_that_does_not_compile_names_its_files(executor: Executor) -> None:
    plan = make_plan(load_preset("default").scene, TIERS["standard"])
    program = plan.programs["present"]
    broken = program.fragment.text.replace("vec3 tone(vec3 x) {", "vec3 tone(vec3 x) { nonsense;")
    fragment = Shader(text=broken, sha256="0" * 64, files=program.fragment.files)
    with pytest.raises(ShaderError, match=r"output/tone\.glsl@photographic from line"):
        executor.compile(program.model_copy(update={"fragment": fragment}))


def test_another_thread_is_refused(executor: Executor) -> None:
    scene = load_preset("default").scene
    plan = make_plan(scene, TIERS["standard"])
    with ThreadPoolExecutor(1) as pool, pytest.raises(RuntimeError, match="only in the thread that created it"):
        pool.submit(executor.render, plan, time=0.0, camera=scene.camera, width=8, height=8).result()
