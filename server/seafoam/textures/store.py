"""Textures by name. The name contains everything needed to generate the bytes, so any process can."""

import gzip
import hashlib
import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from seafoam.masks.catalogue import UnknownMaskError, mask_by_name
from seafoam.masks.formats import quantised, to_u16
from seafoam.masks.prefilter import atlas
from seafoam.textures.foam import foam_texture
from seafoam.textures.front import front_integral
from seafoam.textures.sea import UnknownSeaError, fft_twiddles, sea_spectrum
from seafoam.textures.shore import shore_floor, shore_profiles, with_next_row
from seafoam.textures.spray import spray_rocks

Format = Literal["R8", "R8UI", "R16UI", "RG32UI", "R16F", "R32F", "RG32F", "RGBA32F"]


GZIP_LEVEL = 4


class UnknownTextureError(KeyError):
    """No texture has that name."""


@dataclass(frozen=True)
class TextureData:
    """Mip levels, largest first, concatenated; rows from v = 0, tightly packed, little-endian."""

    name: str
    data: bytes
    sha256: str
    format: Format
    width: int
    height: int
    levels: int

    @cached_property
    def gzipped(self) -> bytes | None:
        """The data compressed by gzip, if that saves at least a quarter: atlases contain each texel four times."""
        packed = gzip.compress(self.data, GZIP_LEVEL, mtime=0)
        return packed if 4 * len(packed) <= 3 * len(self.data) else None


@lru_cache(maxsize=64)
def texture(name: str) -> TextureData:
    """The texture called ``name``.

    ``mask/NAME/ranks`` (R16UI), ``ranks-8`` (R8UI) and ``thresholds-half`` (R16F), ``mask/NAME/atlas`` (RG32UI, see
    :func:`seafoam.masks.prefilter.atlas`), ``mask/NAME/quantiles`` (RG32F, an entry and the next, a row for the
    magnified mask and one for each level) and ``ramps`` (of an octave's ramp; of masks ``A+B`` over one another),
    ``front-integral/C/lnE`` (RGBA32F, a row), ``foam`` (R8, all levels), ``fft-twiddles`` (RG32F, a row),
    ``sea/...`` (RG32F, see :func:`seafoam.textures.sea.sea_spectrum_name`),
    ``shore-floor/TEXELS/GROUND`` (RG32F), ``shore-profiles/NODES/SKEW/SHARPNESS`` (R32F),
    ``spray-rocks/STEEP/GROUND`` (RGBA32F, a row).
    Raises :class:`UnknownTextureError`.
    """
    match name.split("/"):
        case ["foam"]:
            return _pack(name, "R8", _box_levels(foam_texture()[..., None]))
        case ["front-integral", intensity, log_base]:
            return _pack(name, "RGBA32F", [_front(intensity, log_base)[None]])
        case ["fft-twiddles"]:
            return _pack(name, "RG32F", [fft_twiddles()[None]])
        case ["sea", *words]:
            try:
                return _pack(name, "RG32F", [sea_spectrum(words)])
            except UnknownSeaError as error:
                raise UnknownTextureError(name) from error
        case ["shore-floor", texels, ground]:
            return _pack(name, "RG32F", [_shore(name, lambda: shore_floor(texels, ground))])
        case ["shore-profiles", nodes, skew, sharpness]:
            return _pack(
                name,
                "RG32F",
                [_shore(name, lambda: with_next_row(shore_profiles(int(nodes), float(skew), float(sharpness))))],
            )
        case ["spray-rocks", steep, ground]:
            return _pack(name, "RGBA32F", [_shore(name, lambda: spray_rocks(steep, ground))])
        case ["mask", mask_name, kind]:
            return _mask_texture(name, mask_name, kind)
        case _:
            raise UnknownTextureError(name)


def _mask_texture(name: str, mask_name: str, kind: str) -> TextureData:
    try:
        masks = [mask_by_name(part) for part in mask_name.split("+")]
    except (UnknownMaskError, ValueError) as error:
        raise UnknownTextureError(name) from error
    mask = masks[0]
    if len(masks) > 1 and (kind not in ("quantiles", "ramps") or len({each.ranks.shape for each in masks}) > 1):
        raise UnknownTextureError(name)
    size = mask.ranks.shape[0]
    match kind:
        case "ranks":
            return _data(name, "R16UI", size, size, 1, to_u16(mask.ranks))
        case "ranks-8":
            return _data(name, "R8UI", size, size, 1, quantised(mask.ranks, 8).astype(np.uint8).tobytes())
        case "thresholds-half":
            return _pack(name, "R16F", [mask.thresholds[..., None]])
        case "atlas":
            image = atlas(mask.ranks, mask.spans)
            return _data(name, "RG32UI", image.shape[1], size, 1, image.astype("<u4").tobytes())
        case "quantiles":
            return _entries(name, np.concatenate([each.quantiles for each in masks]))
        case "ramps":
            return _entries(name, np.concatenate([each.ramps for each in masks]))
        case _:
            raise UnknownTextureError(name)


def _entries(name: str, tables: NDArray[np.float64]) -> TextureData:
    """Return tables (rows, n) with each entry followed by the next, so that one fetch reads both."""
    return _pack(name, "RG32F", [np.stack((tables[:, :-1], tables[:, 1:]), axis=-1)])


def _shore(name: str, make: Callable[[], NDArray[np.float32]]) -> NDArray[np.float32]:
    try:
        return make()
    except ValueError:
        raise UnknownTextureError(name) from None


def _front(intensity: str, log_base: str) -> NDArray[np.float32]:
    try:
        c, base = float(intensity), float(log_base)
    except ValueError:
        raise UnknownTextureError(f"front-integral/{intensity}/{log_base}") from None
    if not (0.01 <= c <= 1e4 and 0.1 <= base <= 10.0 and math.isfinite(c)):
        raise UnknownTextureError(f"front-integral/{intensity}/{log_base}")
    return front_integral(c, base)


def _box_levels(level: NDArray[np.float64]) -> list[NDArray[np.float64]]:
    levels = [level]
    while level.shape[0] > 1:
        level = 0.25 * (level[0::2, 0::2] + level[1::2, 0::2] + level[0::2, 1::2] + level[1::2, 1::2])
        levels.append(level)
    return levels


def _pack(name: str, kind: Format, levels: list[NDArray[np.float64]] | list[NDArray[np.float32]]) -> TextureData:
    height, width = levels[0].shape[:2]
    if kind == "R8":
        stored = [np.round(255.0 * level).astype(np.uint8) for level in levels]
    else:
        stored = [level.astype("<f2" if kind.endswith("16F") else "<f4") for level in levels]
    return _data(name, kind, width, height, len(levels), b"".join(level.tobytes() for level in stored))


def _data(name: str, kind: Format, width: int, height: int, levels: int, data: bytes) -> TextureData:
    return TextureData(name, data, hashlib.sha256(data).hexdigest(), kind, width, height, levels)
