"""Plans of presets at every tier (half of them without the sweep): whole, with nothing that a scene has not, and drawn
as often as need be.
"""

import re
from itertools import product

import pytest

from seafoam.framegraph.rules import COMPONENTS
from seafoam.framegraph.shader import declared_uniforms
from seafoam.planner import FramePlan, make_plan
from seafoam.quality import TIERS
from seafoam.scene.models import Scene
from seafoam.scene.presets import load_preset, preset_names
from seafoam.textures.store import spec_of, texture, url_of
from support.sweep import REST

ONCE = ("shore: ", "mask: ", "wakes, ", "standing waves, ", "flow of drift", "drift, parts of", "drift, two ")
"""How the names of passes begin that may be drawn for the first frame alone."""
RULE_SIZES = {"constant": 0, "view_projection": 16, "eye_height": 1, "camera": 3, "viewport": 2}


@pytest.fixture(
    scope="module",
    params=[
        pytest.param((name, tier), id=f"{name}-{tier}", marks=() if (i + j) % 2 == 0 else REST)
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
    assert all(one.name.startswith(ONCE) for one in plan.passes if one.when == "setup")
    passes = [one for one in plan.passes if one.name.startswith("shore: ")]
    if scene.shore is None:
        assert "shore" not in plan.canonical_json().decode().lower()
    else:
        assert [one.when for one in passes] == ["setup"] * (len(passes) - 1) + ["frame"]
        assert "shore_smooth" in plan.kept
        assert not plan.kept.keys() & {"shore_near_0", "shore_near_1", "shore_rough", "shore_half", "shore_map"}


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


def test_textures_are_described_by_their_addresses_alone(plan: FramePlan) -> None:
    for entry in plan.textures.values():
        spec = spec_of(entry.url)
        assert url_of(spec) == entry.url
        # The picture of a shore is in its address; servers take 8000 characters.
        assert len(re.sub(r"'image':'[^']*'", "", entry.url)) < 300
        assert len(entry.url) < 4000
        made = texture(spec)
        for field in ("sha256", "format", "width", "height", "levels"):
            assert getattr(made, field) == getattr(entry, field), (entry.url, field)
