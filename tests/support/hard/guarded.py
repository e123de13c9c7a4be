"""Functions of ``shaders/`` at the places where they are guarded."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import pytest

from seafoam.effects.shader import Piece
from seafoam.textures.spec import TextureSpec
from support.probe import Probe


@dataclass(frozen=True)
class Guarded:
    """A function at one place: of ``value``, where ``body`` is evaluated, and what ``y.xy`` is within a thousandth.

    ``given``: constants (in capitals), textures (a description or an address) and uniforms, by name.
    """

    name: str
    files: tuple[Piece, ...]
    body: str
    value: tuple[tuple[float, ...], tuple[float, float]]
    given: Mapping[str, Any] = field(default_factory=dict)

    def check(self, probe: Probe) -> None:
        """Fail where the function has another value."""
        at, want = self.value
        sorts: dict[str, dict[str, Any]] = {"consts": {}, "uniforms": {}, "textures": {}}
        for name, value in self.given.items():
            texture = isinstance(value, str | TextureSpec)
            sorts["consts" if name.isupper() else "textures" if texture else "uniforms"][name] = value
        got = probe(self.files, self.body, np.array([at], np.float32), **sorts)
        assert got[0, :2] == pytest.approx(want, rel=1e-3, abs=1e-3)
