"""Which passes are drawn once, and what their pixels hang on.

A pass is static where no rule of time, camera or picture size reaches it or anything that it reads. Only targets that
nothing else draws into are kept: all passes into them must be static, the first must leave nothing of what they held,
and no other pass may read them before the last.
"""

import hashlib
import json
from collections.abc import Mapping, Sequence
from typing import Any

from seafoam.framegraph.passes import Fullscreen, Pass
from seafoam.framegraph.resources import FixedSize, Target, TargetInput, Texture
from seafoam.framegraph.rules import CameraRule, Held, Loop, Phase, Rule, Uniform, Viewport, Wrap
from seafoam.framegraph.shader import Program, declared_uniforms
from seafoam.framegraph.visibility import reads

_HERE = (0.0, 0.0)


def with_setup(
    passes: Sequence[Pass],
    programs: Mapping[str, Program],
    uniforms: Mapping[str, Uniform],
    targets: Mapping[str, Target],
    textures: Mapping[str, Texture],
) -> tuple[tuple[Pass, ...], dict[str, str]]:
    """The passes with their ``when``, and the targets to keep.

    Of the latter: name -> SHA-256 of all that the pixels hang on (:attr:`seafoam.framegraph.plan.FramePlan.kept`).
    """
    used = [_uniforms_of(one, programs[one.program], uniforms) for one in passes]
    steady = [
        one.eye == "any"
        and one.view == "any"
        and all(_steady(rule) for uniform in of.values() for rule in uniform.rules)
        for one, of in zip(passes, used, strict=True)
    ]
    static = _static_targets(passes, steady, targets)
    timed = tuple(one.model_copy(update={"when": "setup" if one.target in static else "frame"}) for one in passes)
    read = {name for one in timed if one.when == "frame" for name in reads(one)}
    found: dict[str, str] = {}
    for index, one in enumerate(timed):
        if one.when == "setup":
            inputs = {
                name: found[source.target] if isinstance(source, TargetInput) else _sampled(textures[source.texture])
                for name, source in one.inputs.items()
            }
            found[one.target] = _digest(
                {
                    "target": targets[one.target].model_dump(mode="json"),
                    "held": "" if _covers(one) else found[one.target],
                    "vertex": programs[one.program].vertex.sha256,
                    "fragment": programs[one.program].fragment.sha256,
                    "mesh": one.mesh.model_dump(mode="json"),
                    "state": one.state.model_dump(mode="json"),
                    "inputs": inputs,
                    "uniforms": {name: _numbers(uniform, index) for name, uniform in used[index].items()},
                }
            )
    return timed, {name: digest for name, digest in found.items() if name in read}


def _static_targets(passes: Sequence[Pass], steady: Sequence[bool], targets: Mapping[str, Target]) -> set[str]:
    drawn: dict[str, list[int]] = {}
    for index, one in enumerate(passes):
        drawn.setdefault(one.target, []).append(index)
    static = {
        name
        for name, by in drawn.items()
        if name in targets
        and isinstance(targets[name].size, FixedSize)
        and all(steady[index] for index in by)
        and _covers(passes[by[0]])
    }
    while True:
        lost: set[str] = set()
        for index, one in enumerate(passes):
            for name in reads(one):
                by = drawn.get(name, [])
                # What was not drawn yet, or is drawn again, is another picture in the next frame.
                before = bool(by) and by[0] < index
                if one.target in static and not (name in static and before):
                    lost.add(one.target)
                elif one.target not in static and name in static and not (before and by[-1] < index):
                    lost.add(name)
        if not lost:
            return static
        static -= lost


def _covers(one: Pass) -> bool:
    """Whether nothing is left of what the target held."""
    return one.state.clear or (isinstance(one.mesh, Fullscreen) and one.state.blend == "none" and not one.state.depth)


def _uniforms_of(one: Pass, program: Program, uniforms: Mapping[str, Uniform]) -> dict[str, Uniform]:
    declared = declared_uniforms(program.vertex) | declared_uniforms(program.fragment)
    return {name: one.uniforms.get(name) or uniforms[name] for name, sampler in declared.items() if not sampler}


def _steady(rule: Rule) -> bool:
    """Whether a rule gives the same numbers in every frame, in a target of fixed size."""
    match rule:
        case Phase() | Held():
            return rule.rate == 0.0 and rule.k == _HERE
        case Wrap():
            return rule.k == _HERE
        case Loop() | CameraRule() | Viewport(of="picture"):
            return False
        case _:
            return True


def _numbers(uniform: Uniform, index: int) -> list[Any]:
    """What gives a uniform's numbers; where a scene has them does not matter, and the pass's place only where asked."""
    rules = [rule.model_dump(mode="json", exclude={"field"}) for rule in uniform.rules]
    return [
        uniform.type,
        uniform.count,
        *({**rule, "at": index} if rule["rule"] == "pass_index" else rule for rule in rules),
    ]


def _sampled(texture: Texture) -> dict[str, Any]:
    return texture.model_dump(mode="json", exclude={"url"})


def _digest(document: dict[str, Any]) -> str:
    return hashlib.sha256(json.dumps(document, sort_keys=True, separators=(",", ":")).encode()).hexdigest()
