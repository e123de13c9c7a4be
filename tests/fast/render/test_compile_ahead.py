"""Programs compiled ahead of visitors: what is drawn, in which order, and that the process ends with its server."""

import multiprocessing
import os
import time

import pytest

from seafoam.planner import make_plan
from seafoam.quality import TIERS
from seafoam.render import ahead
from seafoam.render.gl.executor import ShaderError
from seafoam.scene.presets import load_preset
from support.api_fakes import FakeRenderer
from support.serving import serving

FEW = ("paper-height", "default", "swell")


class Recording(FakeRenderer):
    """Knows the plans that it drew."""

    drawn: list[str]

    def __init__(self):
        super().__init__()
        self.drawn = []

    def render(self, plan, **how):
        self.drawn.append(plan.sha256)
        return super().render(plan, **how)


@pytest.fixture
def renderer(monkeypatch):
    # The process of the tests keeps its priority and its threads; planning all presets takes ten seconds.
    monkeypatch.setattr(os, "nice", lambda more: 0)
    monkeypatch.setattr(ahead, "preset_names", lambda: FEW)
    monkeypatch.setenv("LP_NUM_THREADS", "1")
    return Recording()


def test_every_preset_is_drawn_once_at_both_tiers_the_page_s_first_preset_first(renderer):
    ahead.draw_ahead(lambda: renderer, os.getppid())
    order = "default fast, default standard, paper-height fast, swell fast, paper-height standard, swell standard"
    pairs = [pair.split() for pair in order.split(", ")]
    assert renderer.drawn == [make_plan(load_preset(name).scene, TIERS[tier]).sha256 for name, tier in pairs]


def test_a_preset_that_does_not_compile_is_named_and_the_others_are_drawn(renderer, monkeypatch, caplog):
    refused = make_plan(load_preset("swell").scene, TIERS["fast"]).sha256
    draw = renderer.render

    def render(plan, **how):
        if plan.sha256 == refused:
            raise ShaderError("no function 'wave'")
        return draw(plan, **how)

    monkeypatch.setattr(renderer, "render", render)
    ahead.draw_ahead(lambda: renderer, os.getppid())
    assert len(renderer.drawn) == 2 * len(FEW) - 1
    assert [record.getMessage() for record in caplog.records] == [
        "swell at fast was not compiled ahead: no function 'wave'"
    ]


def test_nothing_is_drawn_for_a_server_that_has_ended(renderer):
    ahead.draw_ahead(lambda: renderer, -1)
    assert renderer.drawn == []


def compiling() -> list[multiprocessing.process.BaseProcess]:
    return [child for child in multiprocessing.active_children() if child.name == "compile ahead"]


@pytest.mark.parametrize("wanted", [True, False])
def test_the_process_ends_with_its_server(monkeypatch, wanted):
    monkeypatch.delenv("MESA_SHADER_CACHE_DISABLE", raising=False)
    with serving(compile_ahead=wanted) as client:
        client.get("/api/frames/default.png?width=16&height=16")
        until = time.monotonic() + 30.0
        while wanted and not compiling() and time.monotonic() < until:
            time.sleep(0.05)
        assert len(compiling()) == wanted
        assert client.get("/readyz").json()["compiling_ahead"] is wanted
        [*children] = compiling()
    for child in children:
        child.join(30.0)
        assert not child.is_alive()


def test_nothing_is_compiled_for_a_driver_that_keeps_nothing(monkeypatch):
    monkeypatch.setenv("MESA_SHADER_CACHE_DISABLE", "true")
    with serving(compile_ahead=True) as client:
        client.get("/api/frames/default.png?width=16&height=16")
        assert not compiling()
