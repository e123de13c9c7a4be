"""One surface program that contains every effect behind uniforms, with which the planner's programs are compared.

It consists of the same slot files. Functions that several files of a slot define get the file's name as a suffix, and a
function with the original name selects one of them by a uniform. Numbers that a plan writes into the text for its scene
become uniforms too, so that one text draws every scene.
"""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cache
from typing import get_args
from unittest.mock import patch

from seafoam.effects import EFFECTS
from seafoam.effects.effect import Contribution
from seafoam.effects.foam import front
from seafoam.effects.shader import MARCH_AHEAD, Const, Inline, Piece, SlotFile, Source, path_of, refine
from seafoam.framegraph.plan import FramePlan, Fullscreen, Pass, Program, State, declared_uniforms
from seafoam.framegraph.resources import sampler_of, source_of
from seafoam.framegraph.rules import COMPONENTS, Constant, Uniform, number
from seafoam.planner import make_plan, slots
from seafoam.planner.glsl import assemble, read_file, slot_pieces, source_text
from seafoam.planner.slots import GENTLER, MARCH_SLOTS, Join, surface_slots
from seafoam.quality import Quality
from seafoam.scene import Foam, FrontSaturation, HeightSaturation, Look, ParametricWave, Ripples, Scene, Water

SWITCH = "u_uber_"
COMBINE = f"{SWITCH}combine"
"""0: the greatest saturation, 1: the product."""
START = "u_start"
_MARCH: tuple[Piece, ...] = (
    "surface/march.glsl@step",
    refine("refine_water", "waves", "vec3"),
    "surface/march.glsl@begin",
    "surface/bounds.glsl@now_declared",
    *slot_pieces(GENTLER, [SlotFile("marched", "surface/march.glsl@begin")]),
    *(slot.default for slot in (slots.SHORT, slots.BEYOND, slots.APPROACH) if slot.default),
    MARCH_AHEAD,
    "surface/march.glsl@march",
)
_MARCHED = ("u_surface_top", "u_surface_trough", "u_surface_steepest", "u_surface_grain")
NO_START = Pass(
    name="where rays begin",
    when="frame",
    view=(),
    program="surface",
    target="start",
    mesh=Fullscreen(),
    state=State(clear=True),
)
"""A pass that reads nothing and clears its target."""
MOST_WAVES = 16
BY_SCENE = (
    "PARAMETRIC_COUNT",
    "FRONT_COUNT",
    "FRONT_GATED",
    "FRONT_FULL",
    "FRONT_FADING",
    "FOAM_FADES",
    "FOAM_OCTAVES",
    "MASK_ROWS",
    "FOAM_TEXTURED",
)
"""Compile-time numbers that depend on the scene."""

GENERAL: dict[str, Const] = {"PARAMETRIC_KIND": (0,) * MOST_WAVES, "PARAMETRIC_ALIKE": True, "PARAMETRIC_SIGNAL": False}
"""Compile-time numbers of one scene, and values that suffice for all scenes."""

_FUNCTION = re.compile(r"^(?P<returns>\w+) (?P<name>\w+)\((?P<parameters>[^)]*)\) \{", re.MULTILINE)
_WAVES = re.compile(rf"^uniform\s+\w+\s+(\w+)\[{MOST_WAVES}\]", re.MULTILINE)
_UNIFORM_LINE = re.compile(r"^uniform\s+\w+\s+(?P<name>\w+).*\n", re.MULTILINE)

Consts = dict[str, Const]
Signature = tuple[str, str]
"""A function's return type and parameters."""


@dataclass
class _Parts:
    """Contributions of effects, merged; later ones take precedence."""

    files: dict[Piece, SlotFile] = field(default_factory=dict)
    consts: Consts = field(default_factory=dict)
    uniforms: dict[str, Uniform] = field(default_factory=dict)
    inputs: dict[str, str] = field(default_factory=dict)

    def add(self, given: Contribution) -> None:
        self.files |= {file.path: file for file in given.slots}
        self.consts |= given.consts
        self.uniforms |= given.uniforms
        self.inputs |= given.inputs


@dataclass(frozen=True)
class _Uber:
    """The program, its parts, plans with its textures and targets, and the files that each switch selects."""

    program: Program
    parts: _Parts
    plans: tuple[FramePlan, ...]
    switches: Mapping[str, Sequence[Piece]]


def uber_plan(scene: Scene, quality: Quality, *, exact_ripples: bool = True) -> FramePlan:
    """The plan of ``scene`` with its surface drawn by the program with every effect.

    ``exact_ripples``: include the ripples that better tiers sum at each sample.
    """
    uber = _uber(quality, exact_ripples)
    plan = make_plan(scene, quality)
    running = {note.name for note in plan.effects}
    own = _Parts()
    for name, given in _given(scene, quality):
        if name in running:
            own.add(given)
    fixed = own.consts.keys() - set(BY_SCENE) - GENERAL.keys()
    if any(own.consts[name] != uber.parts.consts[name] for name in fixed):
        raise ValueError("the scene has numbers that the program holds fixed")
    numbers = {name: own.consts.get(name, 0.0) for name in BY_SCENE}
    uniforms = {
        **uber.parts.uniforms,
        **own.uniforms,
        COMBINE: number(float(scene.foam is not None and scene.foam.combine == "product")),
        **{f"{SWITCH}{name.lower()}": number(float(value)) for name, value in numbers.items()},
    }
    for switch, paths in uber.switches.items():
        uniforms[switch] = number(float(max((paths.index(path) for path in own.files if path in paths), default=0)))
    text = uber.program.fragment.text
    for name in _WAVES.findall(text):
        uniforms[name] = _padded(uniforms[name])
    declared = declared_uniforms(uber.program.fragment)
    textures = {name: texture for source in (*uber.plans, plan) for name, texture in source.textures.items()}
    targets = {name: target for source in (*uber.plans, plan) for name, target in source.targets.items()}
    named = {sampler_of(name): name for name in (*textures, *targets)}
    available = named | {START: "start"} | uber.parts.inputs | own.inputs
    inputs = {sampler: source_of(name, textures) for sampler, name in available.items() if sampler in declared}
    # A plan of level water intersects a plane and has no start target: all its rays begin at 0.
    free = () if any(spec.target == "start" for spec in plan.passes) else (NO_START,)
    return plan.model_copy(
        update={
            "programs": {**plan.programs, "surface": uber.program},
            # Nor do these mean anything to it.
            "uniforms": {name: number(0.0) for name in _MARCHED} | plan.uniforms | uniforms,
            "textures": textures,
            "targets": targets,
            "passes": (
                *free,
                *(
                    spec.model_copy(update={"inputs": inputs}) if spec.program == "surface" else spec
                    for spec in plan.passes
                ),
            ),
        }
    )


def slot_files(quality: Quality) -> tuple[str, ...]:
    """Every file that fills a slot of the program."""
    return tuple(path for paths in _uber(quality, True).switches.values() for path in paths if path)


def held_effects(quality: Quality) -> frozenset[str]:
    """Names of the effects in the program: those of the paper and its water, clear or milky."""
    return frozenset(note.name for plan in _uber(quality, True).plans for note in plan.effects)


@cache
def _uber(quality: Quality, exact_ripples: bool) -> _Uber:
    if quality.surface.method != "march":
        raise ValueError("the mesh's vertex program knows the waves; only march is compared")
    parts, plans = _Parts(), []
    for scene, asked in _variants(quality, exact_ripples):
        plans.append(make_plan(scene, asked))
        for _, given in _given(scene, asked):
            parts.add(given)
    consts: Consts = {
        **parts.consts,
        **GENERAL,
        "SURFACE_FILTER": quality.surface.filter,
        "FOOTPRINT_X": 1.0,
        "MARCH_STEPS": quality.surface.steps,
        "MARCH_TOLERANCE": quality.surface.tolerance,
        "MARCH_STEP_WIDENS": 0.25,
        "MARCH_STEP_WIDEST": 0.0,
        "REFINE": quality.surface.refine,
    }
    texts, switches = _surface(parts)
    text = _by_uniforms("\n".join(texts), consts)
    fixed = {name: value for name, value in consts.items() if name not in BY_SCENE}
    program = Program(
        vertex=assemble(["vertex/vertex.glsl@fullscreen"], {"FULLSCREEN_DEPTH": 0.0}),
        fragment=assemble([Inline(text)], fixed),
    )
    return _Uber(program, parts, tuple(plans), switches)


def _given(scene: Scene, quality: Quality) -> list[tuple[str, Contribution]]:
    """Contribution of each effect; fronts have phases of their own, which every scene can have."""
    with patch.object(front, "shares_phase", return_value=False):
        given = [(effect.name, effect.contribute(scene.settled, quality)) for effect in EFFECTS]
    return [(name, one) for name, one in given if one is not None]


def _variants(quality: Quality, exact_ripples: bool) -> list[tuple[Scene, Quality]]:
    """Scenes and qualities that together use every file."""
    scenes = [
        Scene(
            waves=(ParametricWave(),),
            foam=Foam(saturation=(FrontSaturation(), HeightSaturation()), look=look, texture=0.5, fade=0.5),
            water=Water(depth=2.0, ripples=Ripples(), aeration=0.1),
        )
        for look in get_args(Look)
    ]
    found = [(scene, quality) for scene in scenes]
    if exact_ripples:
        found.append((scenes[0], quality.model_copy(update={"ripples": "exact"})))
    return found


def _text(piece: Piece) -> str:
    """GLSL of a part of a shader."""
    if isinstance(piece, Inline):
        return piece.text
    return source_text(piece if isinstance(piece, Source) else Source(piece))


def _surface(parts: _Parts) -> tuple[list[str], dict[str, Sequence[Piece]]]:
    """The program's text in pieces, and for each switch the files by number."""
    texts = [read_file(path) for path in ("lib/numbers.glsl", "lib/rays.glsl@camera", "lib/rays.glsl@place")]
    switches: dict[str, Sequence[Piece]] = {}
    helpers: set[Piece] = set()
    for slot in surface_slots("max"):
        files = [file for file in parts.files.values() if file.slot == slot.name]
        if slot in MARCH_SLOTS:
            continue
        if slot.name == "find":
            texts += [_text(piece) for piece in _MARCH]
            continue
        if slot in slots.FOUND or slot.name == "main":
            continue
        filled = {file.slot for file in parts.files.values()}
        if not files and not slot.joins and (slot.default is None or (slot.under and slot.under not in filled)):
            continue
        if not slot.joins and slot.default is not None and slot.default not in {file.path for file in files}:
            files.insert(0, SlotFile(slot.name, slot.default))
        own = {name for file in files for name in _functions(_text(file.path))}
        bodies: dict[Piece, str] = {}
        for file in files:
            bodies[file.path] = _text(file.path)
            for path in file.needs:
                # A helper that only some files of a slot need belongs to their variant.
                if own & _functions(_text(path)).keys():
                    bodies[file.path] = f"{_text(path)}\n{bodies[file.path]}"
                elif path not in helpers:
                    helpers.add(path)
                    texts.append(_text(path))
        if not slot.joins:
            switches[f"{SWITCH}{slot.name}"] = list(bodies)
            shared = [_functions(body) for body in bodies.values()]
            signatures = {name: shared[0][name] for name in shared[0] if all(name in one for one in shared)}
            texts += _choice(f"{SWITCH}{slot.name}", bodies, signatures, "")
            continue
        prefixes = list(dict.fromkeys(file.prefix for file in files))
        for prefix in prefixes:
            mine = {file.path: bodies[file.path] for file in files if file.prefix == prefix}
            switches[f"{SWITCH}{prefix}"] = ["", *mine]
            signatures = {f"{prefix}_{join.suffix}": (join.returns, join.parameters) for join in slot.joins}
            absent = COMBINE if slot.name == "saturation" else "0.0"
            texts += _choice(f"{SWITCH}{prefix}", mine, signatures, absent)
        texts += _saturation(prefixes) if slot.name == "saturation" else [join.glsl(prefixes) for join in slot.joins]
    main = [slot.default for slot in (*slots.FOUND, slots.MAIN) if slot.default]
    return [*texts, *map(_text, main)], switches


def _functions(text: str) -> dict[str, Signature]:
    return {match["name"]: (match["returns"], match["parameters"]) for match in _FUNCTION.finditer(text)}


def _choice(switch: str, bodies: Mapping[Piece, str], signatures: Mapping[str, Signature], absent: str) -> list[str]:
    """The bodies with renamed functions, and functions with the original names that select one of them.

    ``absent``: the value at switch 0, which selects none; without it the first body is number 0.
    """
    texts = []
    # A name may have no two underscores in a row.
    names = (re.sub(r"\W|glsl", "_", path_of(piece) or "") for piece in bodies)
    suffixes = [re.sub(r"_+", "_", name).strip("_") or "none" for name in names]
    for suffix, body in zip(suffixes, bodies.values(), strict=True):
        for name in signatures:
            body = re.sub(rf"\b{name}\b", f"{name}_{suffix}", body)
        texts.append(body)
    for name, (returns, parameters) in signatures.items():
        calls = [f"{name}_{suffix}({_arguments(parameters)})" for suffix in suffixes]
        values = [f"{returns}({absent})", *calls] if absent else calls
        texts.append(_picked(switch, returns, name, parameters, values))
    return texts


def _picked(switch: str, returns: str, name: str, parameters: str, values: Sequence[str]) -> str:
    said = "{};\n        return" if returns == "void" else "return {}"
    cases = [
        f"    if ({switch} == {i}.0) {{\n        {said.format(value)};\n    }}" for i, value in enumerate(values[:-1])
    ]
    return "\n".join([f"{returns} {name}({parameters}) {{", *cases, f"    {said.format(values[-1])};\n}}\n"])


def _arguments(parameters: str) -> str:
    return ", ".join(parameter.split()[-1] for parameter in parameters.split(",") if parameter)


def _saturation(prefixes: Sequence[str]) -> list[str]:
    """Both ways to combine saturations, and the function that selects one."""
    ways: list[Join] = [slots.saturation("max").joins[0], slots.saturation("product").joins[0]]
    calls = [f"{way.name}_{way.how}({way.arguments})" for way in ways]
    return [
        *(replace(way, name=f"{way.name}_{way.how}").glsl(prefixes) for way in ways),
        _picked(COMBINE, ways[0].returns, ways[0].name, ways[0].parameters, calls),
    ]


def _by_uniforms(text: str, consts: Consts) -> str:
    """The text with the scene's numbers as uniforms, arrays of the greatest length, and each uniform declared once."""
    for name in BY_SCENE:
        uniform = f"{SWITCH}{name.lower()}"
        text = re.sub(rf"^(uniform .*)\[{name}\]", rf"\g<1>[{MOST_WAVES}]", text, flags=re.MULTILINE)
        match consts[name]:
            case bool():
                value = f"({uniform} > 0.5)"
            case int():
                value = f"int({uniform})"
            case _:
                value = uniform
        text = re.sub(rf"\b{name}\b", value, text)
    seen: set[str] = set()

    def once(line: re.Match[str]) -> str:
        again = line["name"] in seen
        seen.add(line["name"])
        return "" if again else line[0]

    text = _UNIFORM_LINE.sub(once, text)
    switches = sorted(set(re.findall(rf"\b{SWITCH}\w+", text)))
    return "".join(f"uniform float {name};\n" for name in switches) + text


def _padded(uniform: Uniform) -> Uniform:
    """An array padded to the program's length; elements beyond the scene's own waves are never read."""
    missing = MOST_WAVES - uniform.count
    rest = Constant(value=(0.0,) * (COMPONENTS[uniform.type] * missing))
    return uniform.model_copy(update={"count": MOST_WAVES, "rules": (*uniform.rules, rest)})
