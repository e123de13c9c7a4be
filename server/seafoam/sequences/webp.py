"""Animated WebP from still ones, frame by frame, so that memory holds one frame (WebP Container Specification)."""

import struct
from collections.abc import Iterable
from fractions import Fraction
from itertools import pairwise
from typing import BinaryIO

from seafoam.sequences.errors import OutputError, OutputField

GREATEST_SIDE = 16383
"""Of a lossless WebP, pixels."""
GREATEST_BYTES = (1 << 32) - 10
GREATEST_DURATION = (1 << 24) - 1
"""Of one frame, ms."""
_ANIMATED = 0x02
_REPLACES = 0x02
"""A frame replaces what is below it, without blending."""
_HEADER = 12
"""Bytes of a file before its chunks: RIFF, size, WEBP."""


def write_animation(file: BinaryIO, stills: Iterable[bytes], width: int, height: int, durations: Iterable[int]) -> None:
    """Write an animation that repeats without end.

    stills: lossless WebP files of width × height pixels. durations: of each, ms. Raises :class:`OutputError` where
    the format's limits are exceeded, ``ValueError`` for a still that is not simple lossless WebP.
    """
    sides: tuple[tuple[OutputField, int], ...] = (("width", width), ("height", height))
    for field, side in sides:
        if side > GREATEST_SIDE:
            raise OutputError(field, f"{field} must be at most {GREATEST_SIDE} pixels in WebP, not {side}")
    file.write(b"RIFF\0\0\0\0WEBP")
    file.write(_chunk(b"VP8X", struct.pack("<B3x", _ANIMATED) + _24(width - 1) + _24(height - 1)))
    file.write(_chunk(b"ANIM", struct.pack("<IH", 0, 0)))
    for still, duration in zip(stills, durations, strict=True):
        place = _24(0) + _24(0) + _24(width - 1) + _24(height - 1)
        file.write(_chunk(b"ANMF", place + _24(duration) + bytes([_REPLACES]) + _lossless(still)))
        if file.tell() > GREATEST_BYTES:
            raise OutputError("stop", "stop: WebP holds up to 4 GiB: shorten the sequence or lower its size")
    size = file.tell()
    file.seek(4)
    file.write(struct.pack("<I", size - 8))
    file.seek(size)


def durations_of(count: int, fps: Fraction) -> list[int]:
    """Return the durations of frames in whole ms, whose sum does not drift from ``count / fps``.

    Raises :class:`OutputError` for frames that last more than 16 777 s.
    """
    ends = [round(1000 * index / fps) for index in range(count + 1)]
    if ends[1] > GREATEST_DURATION:
        raise OutputError("fps", f"fps: a frame of WebP lasts up to {GREATEST_DURATION // 1000} s: raise fps")
    return [later - earlier for earlier, later in pairwise(ends)]


def _lossless(still: bytes) -> bytes:
    """Return the chunk VP8L of a still file, with its head."""
    place = _HEADER
    while place + 8 <= len(still):
        name, size = still[place : place + 4], struct.unpack_from("<I", still, place + 4)[0]
        end = place + 8 + size + size % 2
        if name == b"VP8L":
            return still[place:end]
        place = end
    raise ValueError("a still of an animation is not lossless WebP")


def _chunk(name: bytes, content: bytes) -> bytes:
    return name + struct.pack("<I", len(content)) + content + b"\0" * (len(content) % 2)


def _24(value: int) -> bytes:
    return value.to_bytes(3, "little")
