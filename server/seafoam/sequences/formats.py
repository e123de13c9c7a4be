"""Files of a sequence, by PyAV: MP4 (H.264 by x264, AV1 by SVT-AV1) and animated WebP. It needs the extra ``video``."""

from collections.abc import Callable, Iterable
from fractions import Fraction
from pathlib import Path
from typing import TYPE_CHECKING, Literal, cast, get_args

import numpy as np
from PIL import Image

from seafoam.extras import require
from seafoam.sequences.spec import OutputError, OutputField, SequenceError

if TYPE_CHECKING:
    from av import VideoFrame, VideoStream

Codec = Literal["h264", "av1"]
CODECS: tuple[Codec, ...] = get_args(Codec)
Encoding = Literal[Codec, "webp"]

_ENCODERS: dict[Encoding, tuple[str, dict[str, str]]] = {
    # Constant quality: foam is fine grain, which lower ones smear.
    "h264": ("libx264", {"crf": "17", "preset": "medium"}),
    "av1": ("libsvtav1", {"crf": "25", "preset": "8"}),
    # Frame by frame, so that memory holds one.
    "webp": ("libwebp", {"lossless": "1", "compression_level": "0"}),
}
GREATEST_WEBP = 1 << 32
"""Bytes."""
_BT709 = 1
"""Primaries, transfer and matrix of BT.709 by ITU-T H.273; sRGB has the same primaries."""
_LIMITED = 1
"""FFmpeg's name for video range: 16 to 235."""
LEAST_SIDE = 64
"""Of AV1 by SVT-AV1, pixels."""


def check_encoding(width: int, height: int, encoding: Encoding) -> None:
    """Raise :class:`OutputError` for a size that a video cannot have, MissingExtraError without PyAV."""
    require("video")
    sides: tuple[tuple[OutputField, int], ...] = (("width", width), ("height", height))
    for field, side in sides if encoding != "webp" else ():
        if side % 2:
            raise OutputError(field, f"{field} must be even in a video, not {side}")
        if encoding == "av1" and side < LEAST_SIDE:
            raise OutputError(field, f"{field} must be at least {LEAST_SIDE} pixels in AV1, not {side}")


def write_moving(
    path: Path,
    frames: Iterable[Path],
    size: tuple[int, int],
    fps: Fraction,
    encoding: Encoding,
    drawn: Callable[[], None],
) -> None:
    """Write a video, or an animation that repeats without end, of frames, which are PNG files.

    path: absolute, since FFmpeg takes ``a:b`` for protocol ``a``. ``drawn``: called after each; what it raises ends
    the work. Raises :class:`SequenceError` if the encoder fails, :class:`OutputError` for an animation that is larger
    than WebP allows; what else a file cannot have is :func:`check_encoding`'s to refuse.
    """
    import av

    encoder, options = _ENCODERS[encoding]
    animated = encoding == "webp"
    form, header = ("webp", {"loop": "0"}) if animated else ("mp4", {"movflags": "+faststart"})
    try:
        with av.open(str(path), "w", format=form, options=header) as container:
            stream = cast("VideoStream", container.add_stream(encoder, rate=fps, options=options))
            stream.width, stream.height = size
            stream.pix_fmt = "bgra" if animated else "yuv420p"
            if not animated:
                context = stream.codec_context
                context.color_primaries = context.color_trc = context.colorspace = _BT709
                context.color_range = _LIMITED
            for index, file in enumerate(frames):
                frame = _frame(file, animated)
                frame.pts, frame.time_base = index, 1 / fps
                container.mux(stream.encode(frame))
                drawn()
            container.mux(stream.encode(None))
    except av.FFmpegError as error:
        raise SequenceError(f"the encoder of {encoding} failed: {error}") from error
    if animated and path.stat().st_size > GREATEST_WEBP:
        raise OutputError("stop", "stop: WebP holds up to 4 GiB: shorten the sequence or lower its size")


def _frame(file: Path, animated: bool) -> "VideoFrame":
    from av import VideoFrame

    with Image.open(file) as image:
        frame = VideoFrame.from_ndarray(np.asarray(image.convert("RGB")), format="rgb24")
    if animated:
        return frame.reformat(format="bgra")
    return frame.reformat(format="yuv420p", dst_colorspace=_BT709, dst_color_range=_LIMITED)
