"""Files of a sequence: MP4 by PyAV (H.264 by x264, AV1 by SVT-AV1; it needs the extra ``video``), and animated WebP.

WebP is written frame by frame, so that memory holds one frame (WebP Container Specification).
"""

import struct
from collections.abc import Callable, Iterable
from fractions import Fraction
from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING, BinaryIO, Literal, cast, get_args

import numpy as np
from PIL import Image

from seafoam.extras import require
from seafoam.sequences.spec import OutputError, OutputField, SequenceError

if TYPE_CHECKING:
    from av import VideoFrame, VideoStream

Codec = Literal["h264", "av1"]
CODECS: tuple[Codec, ...] = get_args(Codec)

_ENCODERS: dict[Codec, tuple[str, dict[str, str]]] = {
    # Constant quality: foam is fine grain, which lower ones smear.
    "h264": ("libx264", {"crf": "17", "preset": "medium"}),
    "av1": ("libsvtav1", {"crf": "25", "preset": "8"}),
}
_BT709 = 1
"""Primaries, transfer and matrix of BT.709 by ITU-T H.273; sRGB has the same primaries."""
_LIMITED = 1
"""FFmpeg's name for video range: 16 to 235."""
LEAST_SIDE = 64
"""Of AV1 by SVT-AV1, pixels."""


def check_video(width: int, height: int, codec: Codec) -> None:
    """Raise :class:`OutputError` for a size that the codec cannot have, MissingExtraError without PyAV."""
    require("video")
    sides: tuple[tuple[OutputField, int], ...] = (("width", width), ("height", height))
    for field, side in sides:
        if side % 2:
            raise OutputError(field, f"{field} must be even in a video, not {side}")
        if codec == "av1" and side < LEAST_SIDE:
            raise OutputError(field, f"{field} must be at least {LEAST_SIDE} pixels in AV1, not {side}")


def write_video(
    path: Path, frames: Iterable[Path], width: int, height: int, fps: Fraction, codec: Codec, drawn: Callable[[], None]
) -> None:
    """Write an MP4 file of frames, which are PNG files. path: absolute, since FFmpeg takes ``a:b`` for protocol ``a``.
    ``drawn``: called after each; what it raises ends the work.

    Raises :class:`SequenceError` if the encoder fails; what it cannot have is :func:`check_video`'s to refuse.
    """
    import av

    encoder, options = _ENCODERS[codec]
    try:
        with av.open(str(path), "w", format="mp4", options={"movflags": "+faststart"}) as container:
            stream = cast("VideoStream", container.add_stream(encoder, rate=fps, options=options))
            stream.width, stream.height, stream.pix_fmt = width, height, "yuv420p"
            context = stream.codec_context
            context.color_primaries = context.color_trc = context.colorspace = _BT709
            context.color_range = _LIMITED
            for index, file in enumerate(frames):
                frame = _frame(file)
                frame.pts, frame.time_base = index, 1 / fps
                container.mux(stream.encode(frame))
                drawn()
            container.mux(stream.encode(None))
    except av.FFmpegError as error:
        raise SequenceError(f"the encoder of {codec} failed: {error}") from error


def _frame(file: Path) -> "VideoFrame":
    from av import VideoFrame

    with Image.open(file) as image:
        frame = VideoFrame.from_ndarray(np.asarray(image.convert("RGB")), format="rgb24")
    return frame.reformat(format="yuv420p", dst_colorspace=_BT709, dst_color_range=_LIMITED)


GREATEST_BYTES = (1 << 32) - 10
_ANIMATED = 0x02
_REPLACES = 0x02
"""A frame replaces what is below it, without blending."""
_HEADER = 12
"""Bytes of a file before its chunks: RIFF, size, WEBP."""


def write_animation(file: BinaryIO, stills: Iterable[bytes], width: int, height: int, durations: Iterable[int]) -> None:
    """Write an animation that repeats without end.

    stills: lossless WebP files of width × height pixels, without a recipe. durations: of each, ms. Raises
    :class:`OutputError` for an animation that is larger than the format allows.
    """
    file.write(b"RIFF\0\0\0\0WEBP")
    file.write(_chunk(b"VP8X", struct.pack("<B3x", _ANIMATED) + _24(width - 1) + _24(height - 1)))
    file.write(_chunk(b"ANIM", struct.pack("<IH", 0, 0)))
    for still, duration in zip(stills, durations, strict=True):
        place = _24(0) + _24(0) + _24(width - 1) + _24(height - 1)
        # Such a file has one chunk, of the picture.
        file.write(_chunk(b"ANMF", place + _24(duration) + bytes([_REPLACES]) + still[_HEADER:]))
        if file.tell() > GREATEST_BYTES:
            raise OutputError("stop", "stop: WebP holds up to 4 GiB: shorten the sequence or lower its size")
    size = file.tell()
    file.seek(4)
    file.write(struct.pack("<I", size - 8))
    file.seek(size)


def durations_of(count: int, fps: Fraction) -> list[int]:
    """Return the durations of frames in whole ms, whose sum does not drift from ``count / fps``."""
    ends = [round(1000 * index / fps) for index in range(count + 1)]
    return [later - earlier for earlier, later in pairwise(ends)]


def _chunk(name: bytes, content: bytes) -> bytes:
    return name + struct.pack("<I", len(content)) + content + b"\0" * (len(content) % 2)


def _24(value: int) -> bytes:
    return value.to_bytes(3, "little")
