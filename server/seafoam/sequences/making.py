"""Makes a sequence: draws the frames that are missing, then puts them into one file if a file is wanted.

Frames are in a directory, each with its hash: nothing there is taken for finished that is not.
"""

import hashlib
import json
import re
import time
import zipfile
from collections.abc import Callable, Iterator, Mapping
from contextlib import closing
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

import numpy as np
from PIL import Image

from seafoam import files
from seafoam.files import PART, write_whole
from seafoam.render.encode import encode
from seafoam.sequences.formats import Codec, check_video, durations_of, write_animation, write_video
from seafoam.sequences.spec import OtherSequenceError, SequenceError, SequenceSpec, SequenceStoppedError, Workers

MANIFEST = "sequence.json"
"""All that the frames' bytes depend on (:meth:`seafoam.sequences.spec.SequenceSpec.identity`)."""
HASHES = "frames.sha256"
"""A line for each finished frame, as ``sha256sum --check`` reads them."""
MANIFEST_VERSION = 1

_FRAME = re.compile(r"frame-(\d{6})\.png")
_LINE = re.compile(r"([0-9a-f]{64})  frame-(\d{6})\.png")


def frame_name(index: int) -> str:
    return f"frame-{index:06d}.png"


class SequenceFolder:
    """A directory of frames. It is created if it is absent.

    identity: of the sequence. again: frames that are there are drawn again. Raises :class:`OtherSequenceError` if the
    directory holds frames of another sequence or without a manifest, and ``OSError``.
    """

    def __init__(self, path: Path, identity: Mapping[str, Any], *, again: bool = False) -> None:
        self.path = path
        path.mkdir(parents=True, exist_ok=True)
        manifest = {"sequence": MANIFEST_VERSION, **identity}
        for left in path.glob(f"{PART}*"):  # by a process that was killed
            left.unlink()
        found = self._manifest()
        if found is None and any(_FRAME.fullmatch(each.name) for each in path.iterdir()):
            raise OtherSequenceError(f"{path} holds frames without {MANIFEST}: choose another directory")
        if found is not None and again:
            self._empty()
        elif found is not None and found != manifest:
            names = sorted(name for name in found.keys() | manifest.keys() if found.get(name) != manifest.get(name))
            raise OtherSequenceError(f"{path} holds a sequence that differs in {', '.join(names)}")
        write_whole(path / MANIFEST, (json.dumps(manifest, indent=1, ensure_ascii=False) + "\n").encode())

    def frame(self, index: int) -> Path:
        return self.path / frame_name(index)

    def put(self, index: int, content: bytes) -> None:
        """Write a frame, then its hash. Raises ``OSError``."""
        write_whole(self.frame(index), content)
        line = f"{_sha256(content)}  {frame_name(index)}\n"
        with (self.path / HASHES).open("ab") as file:
            file.write(line.encode())

    def finished(self, count: int) -> set[int]:
        """Return which of the first ``count`` frames are there with the hash that was noted. Reads them all."""
        noted = {
            index: sha256 for index, sha256 in self._hashes().items() if index < count and self.frame(index).is_file()
        }
        return {index for index, sha256 in noted.items() if _sha256(self.frame(index).read_bytes()) == sha256}

    def clear(self) -> None:
        """Remove what this class has written, and the directory if nothing else is in it."""
        self._empty()
        if not any(self.path.iterdir()):
            self.path.rmdir()

    def _empty(self) -> None:
        for each in list(self.path.iterdir()):
            if each.name in (MANIFEST, HASHES) or _FRAME.fullmatch(each.name):
                each.unlink()

    def _manifest(self) -> dict[str, Any] | None:
        try:
            document = json.loads((self.path / MANIFEST).read_text(encoding="utf-8"))
        except FileNotFoundError:
            return None
        except ValueError:
            return {}
        return document if isinstance(document, dict) else {}

    def _hashes(self) -> dict[int, str]:
        """Return the noted hashes; a line that was torn by a crash counts for nothing, nor does the one behind it."""
        try:
            text = (self.path / HASHES).read_text(encoding="utf-8", errors="replace")
        except FileNotFoundError:
            return {}
        lines = (_LINE.fullmatch(line) for line in text.splitlines())
        return {int(line[2]): line[1] for line in lines if line}


def _sha256(content: bytes) -> str:
    return hashlib.sha256(content).hexdigest()


Kind = Literal["frames", "zip", "webp", "mp4"]
Stage = Literal["frames", "file"]


@dataclass(frozen=True, slots=True)
class Output:
    """Where a sequence goes. path: a directory for ``frames``, else a file. codec: of ``mp4``."""

    path: Path
    kind: Kind
    codec: Codec = "h264"

    @property
    def frames(self) -> Path:
        """Directory of the frames; that of a file stands beside it until the file is complete."""
        return self.path if self.kind == "frames" else self.path.with_name(f"{self.path.name}.frames")


Tell = Callable[[Stage, int, int, float | None], None]
"""Takes how far a sequence is: frames are drawn, or the file is written; how many, of how many, and the remaining time
of the stage, s; None: unknown."""


class _Meter:
    """Tells the progress of a stage, and stops it."""

    def __init__(self, stage: Stage, total: int, found: int, tell: Tell, stopped: Callable[[], bool]) -> None:
        self._stage, self._total, self._found, self._done = stage, total, found, found
        self._tell, self._stopped = tell, stopped
        self._began = time.monotonic()
        self._say()

    def step(self) -> None:
        self._done += 1
        self._say()

    def _say(self) -> None:
        if self._stopped():
            raise SequenceStoppedError("the sequence was cancelled")
        now = self._done - self._found
        left = (time.monotonic() - self._began) * (self._total - self._done) / now if now else None
        self._tell(self._stage, self._done, self._total, left)


def make_sequence(
    spec: SequenceSpec,
    output: Output,
    workers: Workers,
    *,
    tell: Tell = lambda *_: None,
    stopped: Callable[[], bool] = lambda: False,
    again: bool = False,
) -> int:
    """Make a sequence; what an earlier call left is verified by its hashes and not drawn again. Return how many frames
    were there.

    tell: called after every frame. stopped: asked after every frame. again: draw every frame again. Raises
    :class:`seafoam.sequences.spec.SequenceError`, MissingExtraError without PyAV for ``mp4``, what the workers raise,
    and ``OSError``; finished frames then stay for the next call.
    """
    check_output(spec, output)
    identity = spec.identity(workers.info)
    try:
        with files.only_writer(output.frames):
            folder = SequenceFolder(output.frames, identity, again=again)
            found = folder.finished(spec.count)
            missing = [index for index in range(spec.count) if index not in found]
            meter = _Meter("frames", spec.count, len(found), tell, stopped)
            if missing:
                with closing(workers.draw((index, spec.frame(index)) for index in missing)) as drawn:
                    for index, content in drawn:
                        folder.put(index, content)
                        meter.step()
            if output.kind != "frames":
                _write_file(spec, output, folder, _Meter("file", spec.count, 0, tell, stopped))
                folder.clear()
    except BlockingIOError:
        name = output.path.name
        raise SequenceError(f"another process is writing {name}: wait for it, or choose another name") from None
    return len(found)


def check_output(spec: SequenceSpec, output: Output) -> None:
    """Raise :class:`seafoam.sequences.spec.OutputError` if the output cannot hold the sequence, before any work."""
    job = spec.job
    if output.kind == "mp4":
        check_video(job.width, job.height, output.codec)


def _write_file(spec: SequenceSpec, output: Output, folder: SequenceFolder, meter: _Meter) -> None:
    frames = [folder.frame(index) for index in range(spec.count)]
    size = spec.job.width, spec.job.height
    with files.whole(output.path, alone=True) as part:
        if output.kind == "mp4":
            write_video(part, frames, *size, spec.fps, output.codec, meter.step)
        elif output.kind == "webp":
            with part.open("w+b") as file:
                write_animation(file, _stills(frames, meter), *size, durations_of(spec.count, spec.fps))
        else:  # the same frames give the same bytes
            with zipfile.ZipFile(part, "w", zipfile.ZIP_STORED) as archive:
                for path in frames:
                    archive.writestr(zipfile.ZipInfo(path.name), path.read_bytes())
                    meter.step()


def _stills(frames: list[Path], meter: _Meter) -> Iterator[bytes]:
    for path in frames:
        with Image.open(path) as image:
            pixels = np.asarray(image.convert("RGBA"))
        yield encode(pixels, "webp")
        meter.step()
