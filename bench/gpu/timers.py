"""Seconds of a frame on the GPU, by a timer query around each pass, and whether such queries can be believed."""

import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import Any
from unittest.mock import patch

import moderngl

from bench.drawn.passes import kind
from seafoam.framegraph.plan import FramePlan
from seafoam.render.gl.executor import Executor

LEAST, MOST = 0.7, 1.05
"""A query over the wall time of a long draw: the rest is what it takes to begin and end."""
LONG_SECONDS = 0.03
MOST_STEPS = 1 << 24
LARGEST = (2**32 - 1) / 1e9
"""What the binding reads at most, s: nanoseconds in 32 bits."""
LOAD_SIDE = 512

_VERTEX = """#version 300 es
void main() { gl_Position = vec4(vec2(gl_VertexID % 2, gl_VertexID / 2) * 4.0 - 1.0, 0.0, 1.0); }
"""
# Each step needs the last one's result, which no compiler can know.
_FRAGMENT = """#version 300 es
precision highp float;
uniform int u_steps;
out vec4 o_colour;
void main() {
    float x = gl_FragCoord.x * 0.001;
    for (int i = 0; i < u_steps; i++) x = fract(x * 1.7 + 0.3);
    o_colour = vec4(x);
}
"""


class PassTimer:
    """Times the passes that an executor draws while a context lasts."""

    def __init__(self, executor: Executor) -> None:
        self._executor = executor
        self._queries: list[moderngl.Query] = []
        self._names: list[str] = []

    @contextmanager
    def running(self) -> Iterator[None]:
        """A context that times one frame."""
        self._names.clear()
        draw = self._executor._draw

        def timed(plan: FramePlan, index: int, *given: Any) -> None:
            used = len(self._names)
            if used == len(self._queries):
                self._queries.append(self._executor._context.query(time=True))
            with self._queries[used]:
                draw(plan, index, *given)
            self._names.append(kind(plan.passes[index].name))

        with patch.object(self._executor, "_draw", timed):
            yield

    def seconds(self) -> dict[str, float]:
        """The last frame's queries, summed by kind of pass. Raises ``RuntimeError`` where it had none."""
        if not self._names:
            raise RuntimeError("no pass was seen: the executor draws passes in another way, see bench/gpu/timers.py")
        sums: dict[str, float] = {}
        for name, query in zip(self._names, self._queries, strict=False):
            sums[name] = sums.get(name, 0.0) + 1e-9 * query.elapsed
        return sums


def loads(executor: Executor) -> list[tuple[float, float]]:
    """Seconds of two long draws, the second twice as long: by a timer query, and of the clock until GL has finished."""
    context = executor._context
    program = context.program(vertex_shader=_VERTEX, fragment_shader=_FRAGMENT)
    colour = context.texture((LOAD_SIDE, LOAD_SIDE), 4)
    target = context.framebuffer([colour])
    array = context.vertex_array(program, [])
    query = context.query(time=True)
    target.use()

    def draw(steps: int) -> tuple[float, float]:
        program["u_steps"] = steps
        context.finish()
        began = time.perf_counter()
        with query:
            array.render(moderngl.TRIANGLES, vertices=3)
        context.finish()
        return 1e-9 * query.elapsed, time.perf_counter() - began

    try:
        steps = 64
        draw(steps)
        while draw(steps)[1] < LONG_SECONDS and steps < MOST_STEPS:
            steps *= 2
        return [draw(steps), draw(2 * steps)]
    finally:
        # No released framebuffer stays bound.
        executor._resting.use()
        for one in (array, target, colour, program):
            one.release()


def distrust(pairs: Sequence[tuple[float, float]]) -> str:
    """Why timer queries of known loads cannot be believed; empty if they can."""
    for query, wall in pairs:
        if not LEAST * wall <= query <= MOST * wall:
            return f"a draw that took {1e3 * wall:.1f} ms was given as {1e3 * query:.1f} ms"
    return ""


def plausible(query: float, wall: float) -> bool:
    """Whether a frame's queries can be right: some time, no longer than the frame, and not all that they can hold."""
    return 0.0 < query <= MOST * wall and query < LARGEST
