"""The spectrum of an open sea as a texture, and the roots of unity of its transform."""

import math
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray
from pydantic import Field, field_validator

from seafoam.ocean.waves.cascades import cascades
from seafoam.scene.waves import Sea
from seafoam.textures.spec import Image, TextureSpec

ROOTS = 512


class SeaSpectrum(TextureSpec):
    """Spectrum of an FFT sea, RG32F (4·BAND, 8·BAND): first (Re, Im) of h₀ in m, then (turns in a loop, 0)."""

    kind: ClassVar[str] = "sea"
    sea: Sea
    depth: float | None = Field(default=None, ge=0.05, le=11000.0, description="m; absent: deep water")

    @field_validator("sea")
    @classmethod
    def _spectrum_alone(cls, sea: Sea) -> Sea:
        plain = Sea()
        return sea.model_copy(update={"model": plain.model, "choppiness": plain.choppiness})

    def image(self) -> Image:
        made = cascades(self.sea, self.depth)
        amplitude = np.concatenate([of.h0 for of in made], axis=1)
        turns = np.concatenate([of.turns for of in made], axis=1)
        below = np.stack((amplitude.real, amplitude.imag), axis=-1)
        above = np.stack((turns, np.zeros_like(turns)), axis=-1)
        return Image("RG32F", (np.concatenate((below, above)).astype("<f4"),))


class FftTwiddles(TextureSpec):
    """Roots of unity, RG32F (1, 512)."""

    kind: ClassVar[str] = "fft-twiddles"

    def image(self) -> Image:
        return Image("RG32F", (fft_twiddles()[None].astype("<f4"),))


def fft_twiddles() -> NDArray[np.float32]:
    """(512, 2) float32: cos and sin of 2πj/512, computed by ``math`` alone."""
    angles = [2.0 * math.pi * j / ROOTS for j in range(ROOTS)]
    return np.array([(math.cos(angle), math.sin(angle)) for angle in angles], np.float32)
