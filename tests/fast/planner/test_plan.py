"""Frame plans: same bytes, nothing that the scene does not call for, every uniform ruled, live fields truly live."""

import ast
import json
import re
import subprocess
import sys
from functools import cache
from pathlib import Path
from typing import Any, get_args

import pytest

import seafoam
from seafoam.framegraph.resources import ViewportSize
from seafoam.planner import FramePlan, PlanError, make_plan, planner
from seafoam.planner.glsl import PART, parts_of
from seafoam.quality import TIERS, Quality, SurfaceQuality
from seafoam.resources import data_dir
from seafoam.scene.foam import Drift, DriftSaturation, FrontSaturation, HeightSaturation, Look, SurfSaturation
from seafoam.scene.light import Clouds, Light, Sky, Wind
from seafoam.scene.presets import load_preset, preset_names
from support.scenes import Camera, Foam, ParametricWave, Ring, Ripples, Scene, Sea, Shore, Water, WhitecapSaturation
from support.sweep import spread

STANDARD = TIERS["standard"]


@cache
def made_elsewhere(share: int) -> dict[str, str]:
    """Hashes of a sixth of the presets' plans, by a process in the opposite order, where strings hash otherwise."""
    code = (
        "import json; from seafoam.planner import make_plan; from seafoam.quality import TIERS; "
        "from seafoam.scene.presets import load_preset, preset_names; "
        "print(json.dumps({name: make_plan(load_preset(name).scene, TIERS['standard']).sha256 "
        f"for name in reversed(preset_names()[{share}::6])}}))"
    )
    told = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    return json.loads(told.stdout)


@pytest.mark.parametrize("preset", spread(preset_names(), 6))
def test_same_bytes_in_another_process(preset: str) -> None:
    plan = make_plan(load_preset(preset).scene, STANDARD)
    assert made_elsewhere(preset_names().index(preset) % 6)[preset] == plan.sha256


def test_a_plan_survives_its_json_and_knows_nothing_of_time_camera_and_size() -> None:
    plan = make_plan(load_preset("default").scene, STANDARD)
    assert FramePlan.model_validate_json(plan.canonical_json()) == plan
    scene = load_preset("default").scene
    moved = scene.model_copy(update={"camera": Camera(position=(1e6, 50.0, 3.0), yaw=1.0)})
    assert make_plan(moved, STANDARD).sha256 == make_plan(scene, STANDARD).sha256


def test_a_changed_copy_of_a_plan_has_uniforms_of_its_own() -> None:
    plan = make_plan(load_preset("default").scene, STANDARD)
    constants, others = plan.numbers[0]
    assert all(one.constant for one in constants.values())
    assert not any(one.constant for one in others.values())
    copied = plan.model_copy(update={"passes": plan.passes[1:]})
    assert copied.numbers == plan.numbers[1:]
    assert plan.model_copy() == plan


def test_what_the_scene_does_not_call_for_is_not_there() -> None:
    bare = make_plan(Scene(light=None), STANDARD)
    text = "".join(program.fragment.text for program in bare.programs.values())
    for word in ("u_sun", "u_foam", "u_mask", "u_ripples", "parametric", "fresnel"):
        assert word not in text
    assert not bare.textures
    assert not bare.effects
    assert {one.name for one in bare.passes} == {"surface", "sky", "tone"}
    # A shore has a floor of its own.
    shallow = make_plan(Scene(shore=Shore(), water=Water(depth=3.0)), STANDARD)
    assert "floor" not in {note.name for note in (*shallow.effects, *shallow.skipped)}


@pytest.mark.parametrize("look", get_args(Look))
def test_a_look_brings_its_own_textures_only(look: Look) -> None:
    scene = load_preset("paper-halftone").scene
    plan = make_plan(scene.model_copy(update={"foam": scene.foam.model_copy(update={"look": look})}), STANDARD)
    assert ("mask_ranks" in plan.textures) == (look != "textured")
    assert ("mask_quantiles" in plan.textures) == ("mask_atlas" in plan.kept) == (look == "filtered")
    assert ("foam_texture" in plan.textures) == (look in ("textured", "halftone_textured", "listing"))


def test_more_textures_than_a_shader_may_read_are_refused() -> None:
    """An open sea with folds, rings, ripples, cells and drift at a shore: each by itself can be drawn."""
    foam = Foam(saturation=(WhitecapSaturation(), SurfSaturation(), DriftSaturation()), texture=0.5, texture_second=3.1)
    water = Water(ripples=Ripples())
    scene = Scene(sea=Sea(), rings=(Ring(),), shore=Shore(), drift=Drift(), foam=foam, water=water, light=Light())
    with pytest.raises(PlanError, match=r"would read \d+ textures, and WebGL2 guarantees 16; leave out"):
        make_plan(scene, STANDARD)


def test_clouds_that_water_mirrors_are_a_map_where_a_texture_is_free() -> None:
    """Of a rough sea that mirrors the sky alone; calm water shows what is finer than the map, and so does a boat."""
    light = Light(sky=Sky(clouds=Clouds()))
    foam = Foam(saturation=(WhitecapSaturation(), FrontSaturation()), texture=0.5)
    sea = Scene(sea=Sea(), waves=(ParametricWave(),), foam=foam, water=Water(ripples=Ripples()), light=light)
    # One program holds all of a sea that does not break.
    full = sea.model_copy(
        update={"wind": Wind(speed=6.9), "rings": (Ring(),), "foam": foam.model_copy(update={"texture": 0.0})}
    )
    calm = Scene(waves=(ParametricWave(),), water=Water(ripples=Ripples(slope=0.01)), light=light)
    planar = sea.model_copy(update={"light": light.model_copy(update={"reflection": "planar"})})
    mapped = {True: (sea,), False: (full, calm, planar)}
    for whether, scenes in mapped.items():
        for scene in scenes:
            assert ("clouds_mirrored" in make_plan(scene, STANDARD).targets) is whether
    for tier in ("high", "reference"):
        assert "clouds_mirrored" not in make_plan(sea, TIERS[tier]).targets
    # The planner leaves the map out itself: asked for or not, the plan is the same.
    exact = STANDARD.model_copy(update={"clouds_mirrored": "exact"})
    assert make_plan(full, STANDARD) == make_plan(full, exact)
    assert make_plan(sea, STANDARD) != make_plan(sea, exact)


def at(document: Any, pointer: str) -> tuple[Any, str]:
    *path, last = pointer.lstrip("/").split("/")
    for key in path:
        document = document[int(key) if isinstance(document, list) else key]
    return document, last


@pytest.mark.parametrize("preset", spread(preset_names(), 3))
def test_live_fields_change_nothing_but_their_constants(preset: str) -> None:
    """What the client may do without asking: put the fields' new values where the plan names them."""
    scene = load_preset(preset).scene.settled
    plan = make_plan(scene, STANDARD)
    patched, changed = json.loads(plan.canonical_json()), scene.model_dump(mode="json")
    for pointer in plan.live:
        parent, key = at(changed, pointer)
        old = parent[key]
        parent[key] = [0.9 * x for x in old] if isinstance(old, list) else 0.9 * old
        rules = [rule for uniform in patched["uniforms"].values() for rule in uniform["rules"]]
        named = [rule for rule in rules if rule.get("field") == pointer]
        assert named, pointer
        for rule in named:
            rule["value"] = parent[key] if isinstance(old, list) else [parent[key]]
    theirs = json.loads(make_plan(Scene.model_validate(changed), STANDARD).canonical_json())
    # Words about the scene may quote a number; what draws may not differ.
    for document in (patched, theirs):
        del document["effects"]
    assert theirs == patched


def test_shaders_are_files_of_parts_without_a_preprocessor_raw_time_or_hashed_floats() -> None:
    for path in sorted(data_dir("shaders").rglob("*.glsl")):
        text = path.read_text(encoding="utf-8")
        assert text.count("\n") >= 8, f"{path}: part of another file"
        names = PART.findall(text)
        assert len(set(names)) == len(names), path
        assert text.count("// @part") == len(names), f"{path}: // @part NAME is a line of its own"
        assert not names or all(part.startswith("// ") for part in parts_of(str(path)).values()), path
        assert not re.search(r"\bu_time\b|fract\(\s*sin", text), path
        assert "#" not in text, f"{path}: slots, not the preprocessor"
        assert text.startswith("// "), f"{path} does not say what it computes"


def test_paths_of_shaders_are_whole_and_numbers_summed_alike_in_every_python() -> None:
    """Paths can be searched for; ``sum`` compensates for rounding from Python 3.12 on (``seafoam.sums``)."""
    package = Path(seafoam.__file__).parent
    summed = {"effects", "framegraph", "ocean", "planner", "scene", "textures"}
    for path in package.rglob("*.py"):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id == "sum":
                assert path.relative_to(package).parts[0] not in summed, f"{path}:{node.lineno}"
            if isinstance(node, ast.JoinedStr):
                texts = [part.value for part in node.values if isinstance(part, ast.Constant)]
                made = any(re.search(r"\.glsl\b", str(text)) for text in texts)
                assert not made or path.match("routers/export.py"), f"{path}:{node.lineno}: a path is made of pieces"


def test_a_scene_loads_its_mask_and_draws_the_atlas_once() -> None:
    saturation = (HeightSaturation(base=-1.0, full=1.0),)
    scenes = (Scene(foam=Foam(saturation=saturation, mask=mask), light=None) for mask in ("vac-24", "vac-12"))
    plan, other = (make_plan(scene, STANDARD) for scene in scenes)
    addresses = {one.url for one in plan.textures.values()}
    assert addresses == {f"/api/textures/mask/vac-24/{table}" for table in ("ranks", "quantiles")}
    made = [one for one in plan.passes if one.name.startswith("mask: ")]
    assert {one.when for one in made} == {"setup"}
    assert plan.kept.keys() == other.kept.keys() == {"mask_atlas"}
    assert other.kept != plan.kept


def chosen(**changes: object) -> Quality:
    return STANDARD.model_copy(update=changes)


def made(preset: str, quality: Quality) -> FramePlan:
    return make_plan(load_preset(preset).scene, quality)


def test_kinds_of_choice_and_fewer_samples_are_none() -> None:
    scene = load_preset("default").scene
    assert make_plan(scene, chosen(samples=16, samples_max=16)) == make_plan(scene, chosen(samples=16))
    for samples, most, kinds in ((1, 1, ()), (1, 4, (4,)), (1, 16, (4, 16)), (4, 16, (16,))):
        how = chosen(samples=samples, samples_max=most)
        assert how.chosen_samples == kinds
        names = {one.name for one in make_plan(load_preset("default").scene, how).passes}
        assert {f"surface, {count} samples" for count in kinds} <= names
        assert ("contrast" in names) == bool(kinds)
    # Without light a sample costs less than its choice.
    unlit = make_plan(load_preset("paper-threshold").scene, chosen(samples_max=16))
    assert "contrast" not in {one.name for one in unlit.passes}


def test_pixels_are_less_wide_where_rows_have_detail() -> None:
    widths = (
        *(("default", 4, 4), ("boat-race", 4, 3), ("spray-on-rocks", 4, 3), ("pool-caustics", 2, 1)),
        *(("pool-caustics", 4, 2), ("paper-threshold", 4, 1), ("drift-vortices", 4, 2), ("lake-calm", 4, 2)),
        *(("lake-sunset", 4, 3), ("swell", 1, 1), ("swell", 2, 3), ("swell", 4, 4), ("moonlight", 2, 2)),
    )
    for preset, asked, drawn in widths:
        suited = planner._suited(load_preset(preset).scene.settled, chosen(pixel_width=asked))
        assert suited.pixel_width == drawn, (preset, asked)
    scene = load_preset("boat-race").scene
    assert make_plan(scene, chosen(pixel_width=4)).targets["samples"].size == ViewportSize(narrow=3)
    several = make_plan(scene, chosen(pixel_width=4, samples=4))
    assert several == make_plan(scene, chosen(pixel_width=1, samples=4))


WIDE, FINE = ("finish",), ("surface samples", "surface")
"""Programs of which one has a constant: that which shows wide pixels, and that which finds the water."""


def test_constants_follow_what_a_sample_can_be_and_how_the_water_is_found() -> None:
    """Shares and shifts of rows; seas that break are refined after fewer steps, mirrored land is found more exactly;
    tolerances that are coarse grow with the steps of a march."""
    for preset, quality, programs, lines in (
        ("default", STANDARD, WIDE, ("float ROWS_SHARE = 0.15", "float ROW_SHIFT = 0.125")),
        ("default", chosen(pixel_width=4), WIDE, ("float ROWS_SHARE = 0.0", "float ROW_SHIFT = 0.25")),
        ("coastline", chosen(pixel_width=4), WIDE, ("float ROWS_SHARE = 0.15", "float ROW_SHIFT = 0.25")),
        ("lake-calm", chosen(pixel_width=4), WIDE, ("float ROWS_SHARE = 0.0",)),
        ("paper-wake", chosen(pixel_width=4), WIDE, ("float ROWS_SHARE = 0.5",)),
        ("paper-textured", STANDARD, WIDE, ("float ROWS_SHARE = 0.15",)),
        ("shallows", STANDARD, WIDE, ("float ROWS_SHARE = 0.2",)),
        ("storm", STANDARD, FINE, ("int REFINE = 1", "float MARCH_TOLERANCE = 0.2")),
        ("storm", chosen(surface=SurfaceQuality(refine=2)), FINE, ("int REFINE = 2", "float MARCH_TOLERANCE = 0.1")),
        ("swell", STANDARD, FINE, ("int REFINE = 0", "float MARCH_TOLERANCE = 0.1")),
        ("cubemap-lake", TIERS["fast"], ("met",), ("float MARCH_TOLERANCE = 0.1",)),
        ("default", TIERS["fast"], FINE, ("float MARCH_TOLERANCE = 0.2",)),
        (
            "swell",
            STANDARD,
            FINE,
            ("float MARCH_STEP_WIDENS = 0.25", "float MARCH_STEP_WIDEST = 15.0"),
        ),
        (
            "swell",
            TIERS["fast"],
            FINE,
            ("float MARCH_STEP_WIDENS = 0.1", "float MARCH_STEP_WIDEST = 7.0"),
        ),
        ("swell", TIERS["high"], FINE, ("float MARCH_STEP_WIDEST = 0.0",)),
        ("swell", TIERS["reference"], FINE, ("float MARCH_STEP_WIDEST = 0.0",)),
    ):
        plan = made(preset, quality)
        text = next(plan.programs[name].fragment.text for name in programs if name in plan.programs)
        assert all(f"const {line};" in text for line in lines), (preset, lines)


def test_programs_and_tiles_suit_the_scene() -> None:
    """Not drawn: tiles without waves and hidden ones. Large programs are two; a map of long rings is read in part."""
    for preset, tier, tiles in (("storm", "standard", 4), ("storm", "fast", 3), ("swell", "high", 3)):
        (why,) = (note.why for note in made(preset, TIERS[tier]).effects if note.name == "sea")
        assert f": {tiles} tiles by FFT" in why
    two = (("storm", "standard"), ("beach", "standard"))
    one = (("beach", "fast"), ("default", "standard"), ("swell", "standard"), ("storm", "high"))
    for preset, tier in (*two, *one):
        assert ("surface samples" in made(preset, TIERS[tier]).programs) is ((preset, tier) in two), (preset, tier)
    assert "surface samples" not in made("storm", chosen(foam_relief=True)).programs
    for preset, stride in (("lake-calm", 1), ("explosion", 2)):
        assert f"bounds_512_{stride}" in made(preset, STANDARD).programs
    # Blocks of its bounds cover a map whose side is a power of 2.
    assert made("explosion", chosen(rings_size=600)).targets["rings"].size.width == 512
    # Which tiles the roughness hides: a slider of it asks for another plan.
    assert "/water/roughness" not in made("storm", TIERS["fast"]).live
    assert "/water/roughness" in made("storm", STANDARD).live
