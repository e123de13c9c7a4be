"""Finds the passes that are not drawn in every frame, and what determines their pixels.

A pass is static if neither it nor its inputs depend on camera or picture size, and on time only in steps. Only targets
that nothing else draws into are kept: all passes into them must be static, the first must replace their whole content,
and no other pass may read them before the last.
"""

import hashlib
import json
from collections.abc import Mapping, Sequence
from typing import Any

from seafoam.framegraph.plan import Fullscreen, Pass, Program, uniforms_of
from seafoam.framegraph.resources import FixedSize, Target, TargetInput, Texture
from seafoam.framegraph.rules import CameraRule, Clamp, Loop, Phase, Rule, Uniform, Viewport, Wrap
from seafoam.framegraph.visibility import reads


def with_setup(
    passes: Sequence[Pass],
    programs: Mapping[str, Program],
    uniforms: Mapping[str, Uniform],
    targets: Mapping[str, Target],
    textures: Mapping[str, Texture],
) -> tuple[tuple[Pass, ...], dict[str, str]]:
    """Return the passes with their ``when``, and the targets to keep.

    The latter by name, with the SHA-256 of everything that determines their pixels
    (:attr:`seafoam.framegraph.plan.FramePlan.kept`).
    """
    used = [uniforms_of(drawn, programs[drawn.program], uniforms) for drawn in passes]
    still = [all(_steady(rule) for uniform in own.values() for rule in uniform.rules) for own in used]
    steady = [drawn.eye == "any" and drawn.view == "any" and of for drawn, of in zip(passes, still, strict=True)]
    static = _static_targets(passes, steady, targets)
    timed = tuple(drawn.model_copy(update={"when": "setup" if drawn.target in static else "frame"}) for drawn in passes)
    read = {name for drawn in timed if drawn.when == "frame" for name in reads(drawn)}
    sampled = {name: texture.model_dump(mode="json", exclude={"url"}) for name, texture in textures.items()}
    digests: dict[str, str] = {}
    for index, drawn in enumerate(timed):
        if drawn.when == "setup":
            inputs = {
                name: digests[source.target] if isinstance(source, TargetInput) else sampled[source.texture]
                for name, source in drawn.inputs.items()
            }
            document = {
                "target": targets[drawn.target].model_dump(mode="json"),
                "before": "" if _covers(drawn) else digests[drawn.target],
                "vertex": programs[drawn.program].vertex.sha256,
                "fragment": programs[drawn.program].fragment.sha256,
                "mesh": drawn.mesh.model_dump(mode="json"),
                "state": drawn.state.model_dump(mode="json"),
                "inputs": inputs,
                "uniforms": {name: _numbers(uniform) for name, uniform in used[index].items()},
            }
            text = json.dumps(document, sort_keys=True, separators=(",", ":"))
            digests[drawn.target] = hashlib.sha256(text.encode()).hexdigest()
    return timed, {name: digest for name, digest in digests.items() if name in read}


def _static_targets(passes: Sequence[Pass], steady: Sequence[bool], targets: Mapping[str, Target]) -> set[str]:
    """Return the targets whose pixels are the same in all frames; ``steady``: whether a pass's uniforms are."""
    writers: dict[str, list[int]] = {}
    for index, drawn in enumerate(passes):
        writers.setdefault(drawn.target, []).append(index)
    fixed = {name for name, target in targets.items() if isinstance(target.size, FixedSize)}
    still = {name for name, by in writers.items() if all(steady[i] for i in by) and _covers(passes[by[0]])}
    static = fixed & still
    read = [(index, drawn.target, name) for index, drawn in enumerate(passes) for name in reads(drawn)]
    while True:
        # A target that is read before its first or last pass has other content in the next frame.
        moved = {into for index, into, name in read if name not in static or writers[name][0] >= index}
        moved |= {name for index, into, name in read if into not in static and index <= writers.get(name, [-1])[-1]}
        if not static & moved:
            return static
        static -= moved


def _covers(drawn: Pass) -> bool:
    """Whether a pass replaces the whole content of its target."""
    state = drawn.state
    return state.clear or (isinstance(drawn.mesh, Fullscreen) and state.blend == "none" and not state.depth)


def _steady(rule: Rule) -> bool:
    """Whether a rule gives the same numbers in every frame, or in those of some seconds, in a target of fixed size."""
    match rule:
        case Phase() | Clamp() | Wrap():
            return not rule.rate and rule.k == (0.0, 0.0)
        case Loop():
            return rule.step is not None
        case CameraRule() | Viewport(of="picture"):
            return False
        case _:
            return True


def _numbers(uniform: Uniform) -> list[Any]:
    """Return what determines a uniform's values: its rules without scene fields."""
    rules = (rule.model_dump(mode="json", exclude={"field"}) for rule in uniform.rules)
    return [uniform.type, uniform.count, *rules]
