"""Functions of ``shaders/`` at the places where they are guarded."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import pytest

from seafoam.effects.shader import Piece
from support.probe import Probe


@dataclass(frozen=True)
class Guarded:
    """A function at one place: ``y.xy`` of ``body`` is within a thousandth of ``want``."""

    name: str
    files: tuple[Piece, ...]
    body: str
    at: tuple[float, ...]
    want: tuple[float, float]
    consts: Mapping[str, Any] = field(default_factory=dict)
    uniforms: Mapping[str, Any] = field(default_factory=dict)
    textures: Mapping[str, Any] = field(default_factory=dict)

    def check(self, probe: Probe) -> None:
        """Fail where the function has another value."""
        got = probe(
            self.files,
            self.body,
            np.array([self.at], np.float32),
            consts=self.consts,
            uniforms=self.uniforms,
            textures=self.textures,
        )
        assert got[0, :2] == pytest.approx(self.want, rel=1e-3, abs=1e-3)
