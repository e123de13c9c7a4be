"""Assembled GLSL of a frame plan."""

import re
from functools import lru_cache

from seafoam.framegraph.rules import PlanPart


class SourceFile(PlanPart):
    """A file of the assembled source, and the line (from 1) at which it starts."""

    path: str
    line: int


class Shader(PlanPart):
    """Assembled GLSL ES 3.00 source. ``sha256``: of the UTF-8 text."""

    text: str
    sha256: str
    files: tuple[SourceFile, ...]


class Program(PlanPart):
    """A vertex and a fragment shader."""

    vertex: Shader
    fragment: Shader


_UNIFORM = re.compile(r"^uniform\s+(?P<type>\w+)\s+(?P<name>\w+)", re.MULTILINE)
_SAMPLERS = ("sampler2D", "usampler2D", "sampler2DArray")


@lru_cache(maxsize=1024)
def _declared(text: str) -> tuple[tuple[str, bool], ...]:
    return tuple((match["name"], match["type"] in _SAMPLERS) for match in _UNIFORM.finditer(text))


def declared_uniforms(shader: Shader) -> dict[str, bool]:
    """Return the uniforms that the source declares, and whether each is a sampler."""
    return dict(_declared(shader.text))
