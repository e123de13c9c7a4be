"""Plans of presets and of test scenes: whole, cheap, with nothing that a scene has not, drawn as often as needed."""

import json
import re
from itertools import combinations, product
from pathlib import Path

import pytest

import seafoam
from seafoam.effects import EFFECTS
from seafoam.framegraph.plan import declared_uniforms
from seafoam.framegraph.resources import FixedSize
from seafoam.framegraph.rules import COMPONENTS
from seafoam.planner import FramePlan, make_plan
from seafoam.planner.glsl import read_file
from seafoam.quality import TIERS
from seafoam.scene import Scene, Water, load_preset, preset_names
from seafoam.textures.store import spec_of, url_of
from support.cases import cases_of
from support.hard.pictures import HARD
from support.sweep import REST

ONCE = ("shore: ", "mask: ", "wakes, ", "standing waves, ", "flow of drift", "drift, parts of", "drift, two ")
STEPS = ("spectrum at the births of drops", "sea at the births of drops: ")
"""How the names of passes begin that may be drawn for the first frame alone, and when a step of time begins."""
RULE_SIZES = {"constant": 0, "view_projection": 16, "eye_height": 1, "camera": 3, "viewport": 2}


@pytest.fixture(
    scope="module",
    params=[
        pytest.param((name, tier), id=f"{name}-{tier}", marks=() if (i + j) % 4 == 0 else REST)
        for (i, name), (j, tier) in product(enumerate(preset_names()), enumerate(TIERS))
    ],
)
def drawn(request: pytest.FixtureRequest) -> tuple[Scene, FramePlan]:
    name, tier = request.param
    scene = load_preset(name).scene
    return scene, make_plan(scene, TIERS[tier])


@pytest.fixture(scope="module")
def plan(drawn: tuple[Scene, FramePlan]) -> FramePlan:
    return drawn[1]


def test_every_uniform_is_filled_and_every_reference_resolves(plan: FramePlan) -> None:
    for one in plan.passes:
        program = plan.programs[one.program]
        declared = declared_uniforms(program.vertex) | declared_uniforms(program.fragment)
        assert {name for name, sampler in declared.items() if sampler} == one.inputs.keys()
        for source in one.inputs.values():
            assert getattr(source, "texture", None) in plan.textures or getattr(source, "target", None) in plan.targets
        assert one.target == "screen" or one.target in plan.targets
    for uniform in plan.uniforms.values():
        sizes = [
            len(rule.value)
            if rule.rule == "constant"
            else RULE_SIZES.get(getattr(rule, "what", ""), RULE_SIZES.get(rule.rule, 1))
            for rule in uniform.rules
        ]
        assert sum(sizes) == COMPONENTS[uniform.type] * uniform.count


def test_what_is_drawn_once_is_a_shores_map_but_for_its_last_pass_and_what_is_named(
    drawn: tuple[Scene, FramePlan],
) -> None:
    """By name: a pass that became still by mistake would freeze what it draws."""
    scene, plan = drawn
    assert all(one.name.startswith(ONCE + STEPS) for one in plan.passes if one.when == "setup")
    passes = [one for one in plan.passes if one.name.startswith("shore: ")]
    if scene.shore is None:
        assert "shore" not in plan.canonical_json().decode().lower()
    else:
        # Surf comes and goes; without it the last pass is the share of the open sea.
        moves = ["frame"] if scene.shore.surf.height > 0.0 else ["setup"]
        assert [one.when for one in passes] == ["setup"] * (len(passes) - 1) + moves
        assert ("shore_smooth" if moves == ["frame"] else "shore_share") in plan.kept
        assert not plan.kept.keys() & {"shore_near_0", "shore_near_1", "shore_rough", "shore_half", "shore_map"}


def test_whole_numbers_become_int_without_a_conversion(plan: FramePlan) -> None:
    """One takes llvmpipe sixty instructions: ``as_int`` (lib/texels.glsl)."""
    converted = re.compile(r"\b(int|ivec[23])\((floor|ceil|base|sample_place|gl_FragCoord)\b")
    for name, program in plan.programs.items():
        found = converted.search(program.fragment.text)
        assert found is None, (name, found)


def test_samples_and_steps_read_texels_by_a_nearest_read(plan: FramePlan) -> None:
    """``texelFetch`` is slow on processors; what stands in for it must not filter."""
    filters = {"texture": plan.textures, "target": plan.targets}
    for drawn in plan.passes:
        text = plan.programs[drawn.program].fragment.text
        searched = drawn.program == "surface" and "u_met" not in drawn.inputs
        often = searched or drawn.program in ("start", "met", "fft_8")
        assert not often or "texelFetch(" not in text, drawn.name
        for name in set(re.findall(r"texel_at\((\w+)", text)) & drawn.inputs.keys():
            kind, key = next(iter(drawn.inputs[name].model_dump().items()))
            assert filters[kind][key].filter == "nearest", (drawn.name, name)


def test_a_program_has_an_output_for_every_layer_that_it_draws(plan: FramePlan) -> None:
    """WebGL refuses to draw into a layer that the program leaves out."""
    for drawn in plan.passes:
        target = plan.targets.get(drawn.target)
        if target is not None and target.layers > 1:
            outputs = re.findall(r"layout\(location = (\d)\) out", plan.programs[drawn.program].fragment.text)
            assert len(set(outputs)) >= target.layers, drawn.name


def test_textures_are_described_by_their_addresses_alone(plan: FramePlan) -> None:
    for entry in plan.textures.values():
        assert url_of(spec_of(entry.url)) == entry.url
        # The picture of a shore is in its address; servers take 8000 characters.
        assert len(re.sub(r"'image':'[^']*'", "", entry.url)) < 300
        assert len(entry.url) < 4000


FIGURES = json.loads((Path(__file__).parents[3] / "bench/compiler.json").read_text(encoding="utf-8"))["figures"]
BOUNDS = {
    ("storm", "fast"): 375,
    ("storm", "standard"): 985,
    ("boat-in-storm", "fast"): 395,
    ("open-ocean", "fast"): 425,
    ("open-ocean", "standard"): 960,
}
"""Millions, of all outputs. Before passes drew into layers, of one: 1243, 1862, 1149, 784 and 1468, most of a moving
`storm` without a GPU."""


@pytest.mark.parametrize(("preset", "tier"), BOUNDS)
def test_what_is_drawn_at_any_size_stays_cheap(preset: str, tier: str) -> None:
    plan = make_plan(load_preset(preset).scene.settled, TIERS[tier])
    total = 0
    for drawn in plan.passes:
        target = plan.targets.get(drawn.target)
        if drawn.when == "frame" and target is not None and isinstance(target.size, FixedSize):
            total += target.size.width * target.size.height * FIGURES[f"{preset} {tier} {drawn.program}"][0]
    assert total <= 1e6 * BOUNDS[preset, tier]


def test_hard_cases_call_for_their_effects_and_effects_say_when_they_cannot_be_seen() -> None:
    for effect in EFFECTS:
        found = cases_of(effect)
        assert bool(found.invisible) != bool(found.always_visible), effect.name
    # What is measured on maps takes a moment on small ones.
    small = {"shore_map": 64, "shore_floor": 64, "sea_size": 128}
    shaded = TIERS["standard"].model_copy(update={"foam_relief": True, **small})
    for effect, case in HARD:
        assert all((case.guard, case.times)), case.name
        assert effect.contribute(case.scene, shaded) is not None, f"{case.name} does not call for {effect.name}"
    assert not [one.name for (_, one), (_, other) in combinations(HARD, 2) if one.name == other.name]


def test_files_that_guards_name_are_there() -> None:
    """That they guard is for tests/gpu/numerics/test_mutations.py to say."""
    package = Path(seafoam.__file__).parent
    for _, case in HARD:
        for name in re.findall(r"[\w/]+\.(?:glsl(?:@\w+)?|py)", case.guard):
            assert any(package.rglob(name)) if name.endswith(".py") else read_file(name), f"{case.name}: {name}"


def test_what_hangs_on_a_bound_that_leaves_an_effect_out_is_not_live() -> None:
    """Raising the exposure may bring back what the plan left out, so the page must ask for a new plan."""
    deep = make_plan(Scene(water=Water(depth=500.0)), TIERS["standard"])
    assert "floor" in {note.name for note in deep.skipped}
    assert "/light/exposure" not in deep.live
    assert "/light/visibility" in deep.live
