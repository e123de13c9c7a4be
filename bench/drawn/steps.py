"""Work of the surface's pass per pixel: whether it shows water, and how often the waves are evaluated to find it.

The plan's own program is drawn, with a counter in every function that evaluates the waves, and a ``main`` that finds
what a ray meets first (``surface/met.glsl@first``) and writes the counter. ``RuntimeError`` if the text has no place
for them.
"""

import hashlib
import re
from dataclasses import dataclass

import numpy as np

from seafoam.framegraph.plan import FramePlan, Shader
from seafoam.framegraph.visibility import drawn_passes
from seafoam.planner.surface import SAMPLES
from seafoam.render.gl.executor import Executor
from seafoam.scene import Camera

COUNTER = "bench_evaluations"
_WAVES = re.compile(r"^(?P<head>\w+ (?:waves|waves_\w+)\(vec2 \w+[^)]*\) \{)$", re.MULTILINE)
_OPEN = "vec3 wave = open_waves("
"""Evaluation of the open sea alone, before a shore."""
_MAIN = re.compile(r"^void main\(\) \{$", re.MULTILINE)


@dataclass(frozen=True)
class Steps:
    """Counts of a picture: its share of water, 0 to 1, and evaluations of the waves per pixel in the surface's pass."""

    water: float
    mean: float
    """Mean over pixels that show water; 0 without such pixels."""
    most: float
    """99th percentile of the same."""
    everywhere: float
    """Mean over all pixels of the picture."""


def steps(executor: Executor, plan: FramePlan, *, time: float, camera: Camera, size: tuple[int, int]) -> Steps:
    """Draw the counting program of the surface's pass. Raises ``RuntimeError`` if it cannot count.

    Other passes that help to find the surface, and the searches of boats and drops, are not included.
    """
    counting = counting_plan(plan, camera, size)
    drawn = executor.render(counting, time=time, camera=camera, width=size[0], height=size[1], output="linear").pixels
    water, evaluations, looked = drawn[..., 0] > 0.5, drawn[..., 1], drawn[..., 3] > 0.5
    if not looked.any():
        raise RuntimeError("the counting program drew nothing")
    counts = evaluations[water] if water.any() else np.zeros(1)
    if plan.top > 0.0 and water.any() and not counts.all():
        raise RuntimeError("waves were found without an evaluation that could be counted: see bench/drawn/steps.py")
    return Steps(
        water=float(water.mean()),
        mean=float(counts.mean()),
        most=float(np.quantile(counts, 0.99)),
        everywhere=float(evaluations.mean()),
    )


def counting_plan(plan: FramePlan, camera: Camera, size: tuple[int, int]) -> FramePlan:
    """The plan up to its surface's pass, which writes (water, evaluations, 0, 1) for each pixel that it covers."""
    shown = drawn_passes(plan, camera, *size, "screen")
    # With a shore a separate pass finds the intersections of rays, and where samples are kept, that which keeps them.
    names = {plan.passes[index].name for index in shown}
    name = next(name for name in ("what rays meet", SAMPLES, "surface") if name in names)
    indices = [
        index
        for index, shows in shown.items()
        if shows and plan.passes[index].name == name and "underwater" not in plan.passes[index].program
    ]
    if len(indices) != 1:
        raise RuntimeError(f"a frame has one pass that finds the surface, not {len(indices)}")
    surface = plan.passes[indices[0]]
    program = plan.programs[surface.program]
    counting = program.model_copy(update={"fragment": counting_shader(program.fragment)})
    # Half floats represent integers only up to 2048.
    target = plan.targets[surface.target].model_copy(update={"format": "RGBA32F", "layers": 1})
    return plan.model_copy(
        update={
            "programs": {**plan.programs, surface.program: counting},
            "targets": {**plan.targets, surface.target: target},
            "passes": plan.passes[: indices[0] + 1],
            "linear": surface.target,
        }
    )


def counting_shader(shader: Shader) -> Shader:
    """The surface's fragment shader as one that counts. Raises ``RuntimeError`` where its text is not as expected."""
    text = shader.text
    if "int first_met(" not in text:
        raise RuntimeError("the surface's text has no function that finds what a ray meets first")
    text, mains = _MAIN.subn("void bench_drawn() {", text)
    if mains != 1:
        raise RuntimeError(f"the surface's text has {mains} main functions, not one")
    first = _WAVES.search(text)
    if first is None:
        raise RuntimeError("the surface's text has no function that evaluates the waves")
    counted = _WAVES.sub(rf"\g<head>\n    ++{COUNTER};", text[first.start() :])
    counted = counted.replace(_OPEN, f"++{COUNTER};\n        {_OPEN}")
    text = f"{text[: first.start()]}int {COUNTER} = 0;\n\n{counted}"
    output = next(name for name in ("o_met", "o_shading", "o_color") if f"out vec4 {name};" in text)
    text += f"""
void main() {{
    float tau;
    vec3 wave;
    vec4 ground;
    int met = first_met(camera_ray(sample_place()), tau, wave, ground);
    {output} = vec4(met == WATER ? 1.0 : 0.0, float({COUNTER}), 0.0, 1.0);
}}
"""
    return shader.model_copy(update={"text": text, "sha256": hashlib.sha256(text.encode()).hexdigest()})
