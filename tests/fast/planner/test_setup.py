"""Which passes a picture needs: those that are drawn once, and those that are in view."""

import json
import math
from pathlib import Path

import pytest

from seafoam.effects.shader import Inline
from seafoam.framegraph.plan import BoundingSphere, Fullscreen, Pass, Points, Program, State
from seafoam.framegraph.resources import Target, TargetInput, ViewportSize
from seafoam.framegraph.rules import Clamp, Loop, Phase, Rule, Uniform, Viewport, Wrap, number
from seafoam.framegraph.visibility import drawn_passes, in_view
from seafoam.planner import make_plan
from seafoam.planner.glsl import assemble
from seafoam.planner.schedule import with_setup
from seafoam.quality import TIERS
from seafoam.scene import Camera, Scene, load_preset
from support.probe import WHOLE

STANDARD = TIERS["standard"]
FIXED = Target.model_validate({"size": {"rule": "fixed", "width": 4, "height": 4}, "format": "RGBA16F"})
SHADER = assemble(
    [Inline("uniform float u_number;\nuniform sampler2D u_read;\nout vec4 o;\nvoid main() { o = vec4(0.0); }\n")], {}
)
BLIND = assemble([Inline("uniform float u_number;\nout vec4 o;\nvoid main() { o = vec4(u_number); }\n")], {})
PROGRAMS = {"read": Program(vertex=WHOLE, fragment=SHADER), "blind": Program(vertex=WHOLE, fragment=BLIND)}
STILL = number(1.0)


def one(target: str, *read: str, **fields: object) -> Pass:
    inputs = {"u_read": TargetInput(target=read[0])} if read else {}
    given = {"name": target, "when": "frame", "program": "read" if read else "blind", "mesh": Fullscreen(), **fields}
    return Pass(target=target, inputs=inputs, **given)


def settled(*passes: Pass, number: Uniform = STILL, targets: dict[str, Target] | None = None) -> tuple[str, set[str]]:
    """What each pass is, s for setup or f for frame, and the targets that are kept."""
    found = {"a": FIXED, "b": FIXED, "c": FIXED, **(targets or {})}
    timed, kept = with_setup(passes, PROGRAMS, {"u_number": number}, found, {})
    return "".join(one.when[0] for one in timed), set(kept)


def rules(rule: Rule) -> Uniform:
    return Uniform(type="float", rules=(rule,))


class TestInference:
    def test_what_nothing_moves_is_drawn_once(self) -> None:
        assert settled(one("a"), one("b", "a"), one("screen", "b")) == ("ssf", {"b"})

    @pytest.mark.parametrize(
        ("rule", "still"),
        [
            (Phase(offset=1.0, rate=0.0, k=(0.0, 0.0)), True),
            (Phase(offset=0.0, rate=1.0, k=(0.0, 0.0)), False),
            (Phase(offset=0.0, rate=0.0, k=(0.0, 1e-9)), False),
            (Wrap(k=(0.0, 0.0)), True),
            (Wrap(k=(1.0, 0.0)), False),
            (Clamp(offset=2.0, low=0.0, high=1.0), True),
            (Clamp(offset=2.0, rate=1.0, low=0.0, high=1.0), False),
            (Clamp(offset=2.0, k=(0.0, 1.0), low=0.0, high=1.0), False),
            (Loop(period=3.0), False),
            (Loop(period=3.0, step=0.5), True),
        ],
    )
    def test_a_rule_of_time_or_place_moves_a_pass_and_all_that_reads_it(self, rule: Rule, still: bool) -> None:
        found, kept = settled(one("a"), one("b", "a"), one("screen", "b"), number=rules(rule))
        assert (found, kept) == (("ssf", {"b"}) if still else ("fff", set()))
        own = one("b", "a", uniforms={"u_number": rules(rule)})
        found, kept = settled(one("a"), own, one("screen", "b"))
        assert (found, kept) == (("ssf", {"b"}) if still else ("sff", {"a"}))

    def test_a_target_of_the_pictures_size_or_of_some_eyes_or_views_is_drawn_in_every_frame(self) -> None:
        large = Target(size=ViewportSize(), format="RGBA16F")
        assert settled(one("a"), one("screen", "a"), targets={"a": large}) == ("ff", set())
        size = Uniform(type="vec2", rules=(Viewport(),))
        assert settled(one("a", uniforms={"u_number": size}), one("screen", "a")) == ("sf", {"a"})
        assert settled(one("a", eye=("over",)), one("screen", "a")) == ("ff", set())
        assert settled(one("a", view="rising"), one("screen", "a")) == ("ff", set())

    def test_every_writer_counts(self) -> None:
        moved = {"u_number": rules(Loop(period=1.0))}
        added = State(blend="add")
        assert settled(one("a"), one("a", state=added), one("screen", "a")) == ("ssf", {"a"})
        assert settled(one("a"), one("a", state=added, uniforms=moved), one("screen", "a")) == ("fff", set())
        assert settled(one("a", uniforms=moved), one("a"), one("screen", "a")) == ("fff", set())

    def test_the_first_writer_must_leave_nothing_of_what_was_there(self) -> None:
        for first in ({"state": State(blend="add")}, {"mesh": Points(count=3)}, {"state": State(depth=True)}):
            assert settled(one("a", **first), one("screen", "a")) == ("ff", set())
            cleared = {**first, "state": first.get("state", State()).model_copy(update={"clear": True})}
            assert settled(one("a", **cleared), one("screen", "a")) == ("sf", {"a"})

    def test_a_target_that_is_drawn_again_or_shows_the_last_frame_is_not_kept(self) -> None:
        assert settled(one("a"), one("screen", "a"), one("a"), one("screen", "a")) == ("ffff", set())
        # Among setup passes the order is kept.
        assert settled(one("a"), one("b", "a"), one("a", "b"), one("b", "a"), one("screen", "b")) == ("ssssf", {"b"})
        assert settled(one("a", "b"), one("b", "a"), one("screen", "b")) == ("fff", set())


def test_the_flow_of_drift_and_the_ways_along_it_are_drawn_once() -> None:
    plan = make_plan(load_preset("drift-vortices").scene, STANDARD)
    when = {one.name: one.when for one in plan.passes}
    assert when["flow of drift"] == "setup"
    assert when["drift, parts of a generation back"] == when["drift, two generations further back"] == "setup"
    assert when["drift, ways of the youngest"] == when["drift, followed back"] == "frame"
    assert plan.kept.keys() == {"drift_flow", "drift_still", "drift_older", "mask_atlas"}


def test_plans_share_what_hangs_on_the_same() -> None:
    scene = load_preset("island-surf").scene

    def kept(**changes: object) -> str:
        shore = scene.shore.model_copy(update=changes)
        return make_plan(Scene(shore=shore, light=scene.light, water=scene.water), STANDARD).kept["shore_smooth"]

    assert kept() == make_plan(scene, STANDARD).kept["shore_smooth"]
    assert kept() == kept(sand=(0.1, 0.1, 0.1), place=(9.0, 9.0), plants_from=99.0)
    assert len({kept(), kept(smoothing=9.0), kept(level=0.1), kept(size=400.0)}) == 4
    finer = STANDARD.model_copy(update={"shore_map": 128})
    assert make_plan(scene, finer).kept["shore_smooth"] != kept()


GOLDEN = json.loads((Path(__file__).parents[2] / "golden" / "views.json").read_text(encoding="utf-8"))
PRESETS = {(entry["preset"], entry["tier"]): entry for entry in GOLDEN}


@pytest.mark.parametrize(("preset", "tier"), PRESETS)
def test_pinned_views_are_those_of_today(preset: str, tier: str) -> None:
    plan = make_plan(load_preset(preset).scene, TIERS[tier])
    for picture in PRESETS[preset, tier]["pictures"]:
        drawn = drawn_passes(
            plan, Camera.model_validate(picture["camera"]), picture["width"], picture["height"], "screen"
        )
        assert [[index, shows] for index, shows in drawn.items()] == picture["drawn"]


def test_spheres_are_seen_where_they_touch_the_picture() -> None:
    camera = Camera(position=(1.0, 2.0, 3.0), pitch=0.0, fov=math.pi / 2)
    for centre, radius, seen in (
        ((1.0, 2.0, -7.0), 0.0, True),
        ((1.0, 2.0, 4.0), 0.5, False),
        ((1.0, 2.0, 4.0), 1.5, True),
        ((1.0, 22.0, -7.0), 7.0, False),
        ((1.0, 22.0, -7.0), 7.2, True),
        ((31.0, 2.0, -7.0), 4.4, False),
        ((31.0, 2.0, -7.0), 4.5, True),
    ):
        assert in_view((BoundingSphere(centre=centre, radius=radius),), 0.0, camera, 200, 100) == seen
    assert not in_view((), 0.0, camera, 200, 100)
