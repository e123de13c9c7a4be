"""The bench's own arithmetic, on a GPU too, and what its tables are made of. Without GL."""

import re
from collections import deque
from collections.abc import Callable
from concurrent.futures import Future
from pathlib import Path
from typing import Any

import pytest
from bench import document
from bench.drawn.frames import Cost
from bench.drawn.passes import Frame, Taken
from bench.drawn.steps import counting_shader
from bench.gpu import __main__ as command
from bench.gpu import page
from bench.gpu.budget import Budget
from bench.gpu.devices import Device, choose
from bench.gpu.page import Report, Served
from bench.gpu.tasks import Draw, Drawn, Judge, Judged, StaleTruthError, Task, order
from bench.report import Column, Table
from bench.served.water_page import Frames
from bench.served.yardstick import GROUPS, MEASURED, Measured

from references.bake import TIMES
from seafoam.planner import make_plan
from seafoam.quality import TIERS
from seafoam.render.gl.executor import NoRendererError
from seafoam.scene import load_preset, preset_names
from support.parity import Parity
from support.serving import Clock


def _cost(*seconds: float) -> list[Cost]:
    return [Cost(wall=one, cpu=2.0 * one) for one in seconds]


def test_a_round_is_held_against_three_js_before_and_after_it() -> None:
    measured = Measured()
    measured.add(_cost(0.3, 0.2, 0.4), [Frames((0.1, 0.1), cpu=0.1), Frames((0.3, 0.3, 0.3), cpu=0.5)])
    measured.add(_cost(0.5), [Frames((0.5,), cpu=0.25), Frames((0.5,), cpu=0.25)])
    assert measured.wall == pytest.approx([1.0, 1.0])
    assert measured.cpu == pytest.approx([0.6 / 0.3, 1.0 / 0.25])
    assert measured.frames == pytest.approx([1.0, 2.0 / 3.0, 4.0 / 3.0, 1.0])
    assert measured.seconds == pytest.approx(0.35)
    assert measured.three_seconds == pytest.approx(0.4)


def test_every_preset_but_the_mask_alone_is_in_one_group_of_the_yardstick() -> None:
    grouped = [name for group in GROUPS for name in group.presets]
    assert sorted([*grouped, "paper-threshold"]) == sorted(preset_names())
    assert all(group.aim[tier] < group.must[tier] for group in GROUPS for tier in MEASURED)
    assert all(group.must["fast"] < group.must["standard"] for group in GROUPS)


def test_a_counting_text_counts_in_every_function_that_evaluates_waves() -> None:
    """And its main only finds what a ray meets first."""
    # waves and waves_shading; before a shore, the open sea's waves alone.
    for preset, name, count in (("default", "surface", 2), ("beach", "met", 3)):
        plan = make_plan(load_preset(preset).scene, TIERS["standard"])
        text = counting_shader(plan.programs[name].fragment).text
        assert text.count("++bench_evaluations;") == count
        _, _, main = text.partition("void main() {")
        assert "first_met(" in main
        assert "foam" not in main


def _pass(name: str, seconds: float, *, kept: bool = False) -> Taken:
    return Taken(name, "program", 64, 64, seconds, kept)


FRAME = Frame(
    "sea",
    0.5,
    (
        _pass("shore: flood, 8 texels", 0.1, kept=True),
        _pass("sea: rows, 1 to 8", 0.1),
        _pass("earlier folds 0, 17.5 m tile", 0.05),
        _pass("sea, 17.5 m tile", 0.05),
        _pass("surface", 0.3),
    ),
)


def test_a_run_is_written_into_the_docs(tmp_path: Path) -> None:
    """Sections that were measured are new, the others as they were, and pictures of presets that are gone are gone."""
    (tmp_path / "performance.md").write_text(
        "<!-- bench: yardstick on Mesa 25 -->\n<!-- end -->\n<!-- bench: yardstick on Mesa 22 -->\nkept\n<!-- end -->\n"
        "<!-- bench: page -->\nkept\n<!-- end -->\n",
        encoding="utf-8",
    )
    old = tmp_path / "pictures" / "passes" / "gone.webp"
    old.parent.mkdir(parents=True)
    old.write_bytes(b"")
    table = Table("Title", "A note.", (Column("a", "first"),), [("x",)])
    document.write({"GL": "4.5 Mesa 25.0.7"}, {"yardstick": [table], "http": [table]}, [FRAME], tmp_path)
    written = (tmp_path / "performance.md").read_text(encoding="utf-8")
    assert written == (
        "<!-- bench: yardstick on Mesa 25 -->\n```\nGL  4.5 Mesa 25.0.7\n\nTitle\nA note.\n\nfirst\n-----\nx\n```\n"
        "<!-- end -->\n<!-- bench: yardstick on Mesa 22 -->\nkept\n<!-- end -->\n"
        "<!-- bench: page -->\nkept\n<!-- end -->\n"
    )
    passes = (tmp_path / "passes.md").read_text(encoding="utf-8")
    assert "| sea | 2 | 150 | 30.0 % |\n" in passes
    assert "| shore | 1 | 100 | once |\n" in passes
    named = re.findall(r"\((pictures/passes/.*?\.webp)\)", passes)
    assert named == ["pictures/passes/all.webp", "pictures/passes/sea.webp"]
    assert {path.relative_to(tmp_path).as_posix() for path in old.parent.iterdir()} == set(named)


GPU = Device(1, renderer="Some GPU/PCIe", version="4.6", vendor="Some")
LLVMPIPE = Device(0, renderer="llvmpipe (LLVM 15.0.6, 256 bits)", version="4.5", vendor="Mesa")
BROKEN = Device(2, problem="no OpenGL context: eglInitialize failed")
SIZE = (1280, 720)


class Pool:
    """Does each piece of work at once, for which it takes some seconds of a clock."""

    def __init__(self, clock: Clock, seconds: float, result: Callable[[Task], Any]) -> None:
        self.clock, self.seconds, self.result = clock, seconds, result
        self.timeouts: list[float] = []

    def schedule(self, _: Callable[..., Any], args: list[Task], timeout: float) -> Future[Any]:
        self.timeouts.append(timeout)
        self.clock.now += self.seconds
        future: Future[Any] = Future()
        found = self.result(args[0])
        if isinstance(found, Exception):
            future.set_exception(found)
        else:
            future.set_result(found)
        return future


def drawn(task: Draw, query: float | None = 0.002, wall: float = 0.004, faults: tuple[str, ...] = ()) -> Drawn:
    passes = {"sky": 0.25 * query, "surface": 0.75 * query} if query else {}
    return Drawn(task, ready=1.0, first=0.1, passes=passes, wall=wall, rounds=9, faults=faults)


def judged(near: float, flipped: float = 0.0, *, hard: bool = False, preset: str = "beach") -> Judged:
    return Judged(Judge(preset, 2.7), Parity((160, 90), near, whole=0.2, flipped=flipped, tone=0.0, hard=hard))


def a_report(**given: Any) -> Report:
    return Report({"GL_RENDERER": "Some GPU/PCIe"}, software=False, budget=300.0, wanted=9, **given)


class TestDevice:
    def test_where_none_draws_each_reason_is_said_and_so_is_what_few_units_draw(self) -> None:
        with pytest.raises(NoRendererError, match=r"device 2: no OpenGL.*default device: crashed"):
            choose([BROKEN, Device(None, problem="crashed")])
        assert not GPU.note
        note = Device(0, renderer="NVIDIA H200/PCIe/SSE2").note
        assert "two of its 66" in note
        assert note in page.page(a_report(note=note), "make gpu")


class TestBudget:
    def test_nothing_is_begun_that_took_longer_than_what_is_left(self) -> None:
        clock = Clock(0.0)
        budget = Budget(100.0, clock)
        assert budget.has_room("fast")
        budget.took("fast", 5.0)
        budget.took("reference", 30.0)
        budget.took("reference", 20.0)
        clock.now = 65.0
        assert (budget.spent, budget.left(), budget.left(reserved=10.0)) == (65.0, 35.0, 25.0)
        assert budget.has_room("reference")
        assert not budget.has_room("reference", reserved=10.0)
        assert budget.has_room("fast", reserved=10.0)
        # Of a kind that has not been seen, one as long as any.
        assert not budget.has_room("high", reserved=10.0)
        clock.now = 200.0
        assert budget.left() == 0.0
        assert not Budget(0.0, clock).has_room("fast")

    def test_what_is_left_out_is_named(self) -> None:
        clock, report = Clock(0.0), a_report()
        work: list[Task] = [Draw(f"p{number}", "fast", SIZE) for number in range(6)]
        pool = Pool(clock, 10.0, lambda task: drawn(task))
        command._schedule(pool, report, deque(work), 1, Budget(45.0, clock), reserved=10.0)
        assert [one.task.preset for one in report.drawn] == ["p0", "p1", "p2"]
        assert report.skipped == {f"p{number}, fast, 1280 × 720": command.NO_TIME for number in (3, 4, 5)}
        # None may run into the time that is kept back.
        assert pool.timeouts == [35.0, 25.0, 15.0]
        assert not report.wrong

    def test_what_fails_is_wrong_and_what_did_not_end_is_skipped(self) -> None:
        stale, bad = StaleTruthError("of an earlier preset"), ValueError("no\nGL")
        outcomes = {"late": TimeoutError(), "stale": stale, "bad": bad}
        report = a_report()
        work: list[Task] = [Judge(name, 2.7) for name in (*outcomes, "good")]
        pool = Pool(Clock(0.0), 0.0, lambda task: outcomes.get(task.preset, judged(0.1)))
        command._schedule(pool, report, deque(work), 2, Budget(9.0, Clock(0.0)), reserved=0.0)
        assert len(report.judged) == 1
        assert report.wrong == {"bad, parity at 2.7 s": "ValueError: no"}
        assert report.skipped["stale, parity at 2.7 s"] == "of an earlier preset"
        assert "not finished" in report.skipped["late, parity at 2.7 s"]


def test_every_preset_is_drawn_at_every_tier_and_judged_at_every_time() -> None:
    names = preset_names()
    tasks = order(names, SIZE, None)
    assert len(set(tasks)) == len(tasks) == len(names) * (len(TIERS) + len(TIMES))
    assert {(one.preset, one.tier) for one in tasks if isinstance(one, Draw)} == {(n, t) for n in names for t in TIERS}
    assert {(one.preset, one.time) for one in tasks if isinstance(one, Judge)} == {(n, t) for n in names for t in TIMES}
    # Of each preset one frame and one comparison before anything else.
    assert {one.preset for one in tasks[: 2 * len(names)]} == set(names)
    assert {one.kind for one in tasks[: 2 * len(names)]} == {"standard, 1280 × 720", "parity"}
    assert len(order(names, SIZE, (3840, 2160))) == len(tasks) + len(names)


class TestPage:
    def test_all_that_was_found_and_all_that_was_left_out_is_in_it(self) -> None:
        report = a_report(
            drawn=[drawn(Draw("beach", "high", SIZE), faults=("a blank picture",))],
            judged=[judged(0.1), judged(0.9, preset="storm")],
            served=[Served("default, png", 4, 55.5, {"queue": 0.001, "encode": 0.01})],
            failed={"river, fast": "ShaderError: x"},
            skipped={"lagoon, high": command.NO_TIME},
        )
        text = page.page(report, "make gpu")
        assert "\n    make gpu\n" in text
        assert "GL_RENDERER  Some GPU/PCIe" in text
        assert "1 preset and tier pairs drawn; 1 of 2 frames within" in text
        assert "3 wrong, 1 skipped" in text
        for line in (
            "- river, fast: ShaderError: x",
            "- beach, high, 1280 × 720: a blank picture",
            "- storm, parity at 2.7 s: below 1° 0.9 > 0.5",
            "- lagoon, high: no time was left",
        ):
            assert line in text
        assert "55.5" in text
        assert "GL timer queries" in text
        assert "without a GPU" not in text

    def test_neither_a_software_renderer_nor_a_part_writes_the_gpus_page(
        self, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
    ) -> None:
        monkeypatch.setattr(command, "survey", lambda _: [LLVMPIPE])
        monkeypatch.setattr(command, "_measured", lambda *_: pytest.fail("measured"))
        for given in ([], ["--output", str(command.PAGE)]):
            assert command.main(given) == 2
            assert "--output FILE" in capsys.readouterr().err
        for part in (["--presets", "beach"], ["--size", "64x36"]):
            with pytest.raises(SystemExit, match="2"):
                command.main(part)
