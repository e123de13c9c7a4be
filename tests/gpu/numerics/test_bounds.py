"""What sources of waves declare, or measure in each frame, as the most that their surface can be: held at 10⁵ places.

A march that steps by these bounds passes no crest (docs/formulae.md, section 3).
"""

import hashlib
from functools import cache

import numpy as np
import pytest

from seafoam.framegraph.plan import FramePlan
from seafoam.framegraph.resources import FixedSize, Target
from seafoam.planner import make_plan
from seafoam.planner.glsl import read_file
from seafoam.quality import TIERS
from seafoam.render.gl.executor import Executor
from seafoam.scene.boats import Boat
from seafoam.scene.current import Current, Stone
from seafoam.scene.models import Scene
from seafoam.scene.presets import load_preset, preset_names
from support.exact import UNFILTERED
from support.pictures import draw
from support.report import Report
from support.sweep import crossed

SIDE = 192
QUALITIES = {"standard": TIERS["standard"], "exact": UNFILTERED}
TIMES = (0.0, 12.3, 1e6 + 3.5)
SPANS = (12.0, 150.0)
TABLE = "Bounds of the surface, and the most that is met at 10⁵ places and times"

_MAIN = """out vec4 o_start;

void main() {{
    vec2 p = (gl_FragCoord.xy / {side:.1f} - 0.5) * {span:.1f};
    vec3 here = waves(p);
    vec3 ray = vec3(p.x, 0.0, p.y);
    vec3 bounds = surface_bounds(ray, 0.0, 0.9);
    // Ways lead up to 4 m from here: those that stay beyond count as such.
    vec3 beyond = surface_beyond(ray, 0.0);
    if (1.0 - 4.0 / length(ray) >= beyond.x) {{
        bounds.yz -= beyond.yz;
    }}
    bounds.y -= {gentler};
    vec3 few = {few};
    vec3 fewest = {fewest};
    float over = max(here.x - bounds.x, u_surface_trough - here.x);
    float steeper = length(here.yz) - bounds.y;
    float risen = 0.0;
    float bend = 0.0;
    float away = 0.02;
    for (int j = 0; j < 7; ++j) {{
        for (int i = 0; i < 8; ++i) {{
            float angle = {angle};
            vec2 s = away * vec2(cos(angle), sin(angle));
            vec3 there = waves(p + s);
            float line = here.x + dot(here.yz, s);
            // How far the surface stands over either bound.
            float first = here.x + bounds.y * away;
            float second = line + 0.5 * bounds.z * away * away;
            // The long waves bend less; the short ones stand over them by their height at most.
            float third = line - few.x - dot(few.yz, s) + fewest.x + 0.5 * (bounds.z - fewest.z) * away * away;
            risen = max(risen, there.x - min(min(first, second), third));
            bend = max(bend, (there.x - line) / (0.5 * away * away));
        }}
        away *= 2.3;
    }}
    o_start = vec4(over, steeper, risen, bend);
}}
"""


_LAND = """out vec4 o_start;

float share(int i) {
    uvec2 at = uvec2(gl_FragCoord.xy);
    return noise_share(noise_hash(noise_hash(noise_hash(at.x) ^ at.y) ^ uint(i)));
}

void main() {
    vec2 q = 1.4 * u_shore_size * (vec2(share(0), share(1)) - 0.5);
    float y = max(shore_floor(q).x, 0.0) + 0.05 + u_shore_top * share(2) * share(2);
    float heading = 6.2831853 * share(3);
    vec3 r = vec3(cos(heading), 0.5 * share(4) * share(4) * (share(5) - 0.7), sin(heading));
    // Rays alone, and beams of a tile's width and of many.
    float aside = share(6) < 0.3 ? 0.0 : 0.1 * share(7) * share(7);
    float raised = aside * share(8);
    float free = land_free(q, y, r, aside, raised, 0.0, 1e5);
    float far = min(free, 3.0 * u_shore_size);
    float inside = -1e9;
    for (int i = 1; i < 400; ++i) {
        float tau = far * float(i) / 400.0;
        for (int j = -2; j <= 2; ++j) {
            vec2 at = q + tau * (r.xz + 0.5 * float(j) * aside * vec2(-r.z, r.x));
            float land = shore_inside(at).x * shore_inside(at).y * shore_floor(at).x;
            inside = max(inside, land > 0.0 ? land - y - tau * (r.y - raised) : -1e9);
        }
    }
    o_start = vec4(inside, free < 1e5 ? 1.0 : 0.0, far / u_shore_size, 0.0);
}
"""


def probing(plan: FramePlan, span: float) -> FramePlan:
    """The plan with its pass of starts drawing what breaks a bound instead: over, steeper, risen (m), bend (1/m)."""
    told = any("waves/sea.glsl@short" in effect.files for effect in plan.effects)
    few, fewest = ("sea_short", "short_bounds()") if told else ("vec3(0.0)", "vec3(0.0)")
    # What bounds of standing waves are told for is the ray's own way, not those to its sides.
    stand = any(effect.name == "standing waves" for effect in plan.effects)
    angle = "atan(p.y, p.x)" if stand else "0.785398 * float(i) + 0.1 * float(j)"
    measured = "stones_bounds" in plan.targets
    gentler = "stones_gentler(ray, 0.9)" if measured else "0.0"
    main = _MAIN.format(side=float(SIDE), span=span, few=few, fewest=fewest, angle=angle, gentler=gentler)
    # Its texture is declared already.
    of_stones = read_file("waves/standing.glsl@gentler").replace("uniform sampler2D", "// ") if measured else ""
    return instead(plan, (read_file("waves/sea.glsl@short_bounds") if told else "") + of_stones + main)


def instead(plan: FramePlan, main: str) -> FramePlan:
    """The plan with its pass of starts drawing by another ``main`` into a target of SIDE x SIDE."""
    pass_ = next(one for one in plan.passes if one.target == "start")
    program = plan.programs[pass_.program]
    text = program.fragment.text
    text = text[: text.index("out vec4 o_start;")] + main
    fragment = program.fragment.model_copy(update={"text": text, "sha256": hashlib.sha256(text.encode()).hexdigest()})
    return plan.model_copy(
        update={
            "programs": plan.programs | {pass_.program: program.model_copy(update={"fragment": fragment})},
            "targets": plan.targets | {"start": Target(size=FixedSize(width=SIDE, height=SIDE), format="RGBA32F")},
            "linear": "start",
        }
    )


@cache
def scenes() -> dict[str, Scene]:
    """Every preset whose surface is not level, boats of other speeds than theirs, and stones."""
    found = {name: load_preset(name).scene for name in preset_names()}
    for speed, radius in ((2.0, 20.0), (5.0, 30.0), (9.0, 80.0)):
        found[f"a boat at {speed:g} m/s"] = Scene(
            boats=(Boat(centre=(0.0, 0.0), radius=radius, speed=speed, wake=0.4),)
        )
    stones = (Stone(place=(5.0, 2.0), radius=0.4, waves=1.0), Stone(place=(-3.0, 1.0), radius=2.0, waves=1.0))
    found["stones in a current"] = Scene(current=Current(speed=2.5, direction=2.5, stones=stones))
    return {name: scene for name, scene in found.items() if make_plan(scene, TIERS["standard"]).top > 0.0}


@pytest.mark.parametrize(("name", "quality"), crossed(sorted(scenes()), QUALITIES, len(QUALITIES), 4))
def test_no_wave_passes_its_bounds(name: str, quality: str, executor: Executor, report: Report) -> None:
    scene = scenes()[name]
    plan = make_plan(scene, QUALITIES[quality].model_copy(update={"samples": 1}))
    worst = np.full(4, -np.inf)
    for span in (*SPANS, 1500.0) if scene.shore else SPANS:
        drawn = probing(plan, span)
        for time in TIMES:
            camera = scene.camera.model_copy(
                update={"position": (7.0, 5.0, -3.0) if scene.boats else scene.camera.position}
            )
            pixels = draw(executor, drawn, camera, time=time, size=(64, 36), output="linear")
            worst = np.maximum(worst, pixels.reshape(-1, 4).max(axis=0))
    over, steeper, risen, bend = worst
    grain = plan.uniforms["u_surface_grain"].rules[0].value[0]  # type: ignore[union-attr]
    report.add(
        TABLE,
        scene=f"{name}, {quality}",
        over=f"{over:.3g} m",
        steeper=f"{steeper:.3g}",
        risen=f"{risen:.2g} m",
        grain=f"{grain:.2g} m",
        bend=f"{bend:.3g} /m",
    )
    assert over <= 1e-3
    assert steeper <= 1e-3
    assert risen <= grain + 1e-3


@pytest.mark.parametrize("texels", [64, 128, 512])
@pytest.mark.parametrize("name", ["coastline", "lagoon", "spray-on-rocks"])
def test_what_the_tree_calls_free_has_no_land(name: str, texels: int, executor: Executor) -> None:
    quality = TIERS["standard"].model_copy(update={"samples": 1, "shore_floor": texels})
    scene = load_preset(name).scene
    drawn = instead(make_plan(scene, quality), _LAND)
    pixels = draw(executor, drawn, scene.camera, time=0.0, size=(64, 36), output="linear")
    inside, met, far, _ = pixels.reshape(-1, 4).T
    assert inside.max() <= 1e-3
    # Some beams meet land after a way, others none.
    assert 0.05 < met.mean() < 0.95
    assert far.mean() > 0.05
