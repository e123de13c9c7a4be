"""Frames of a sequence in a directory, each with its hash: nothing there is taken for finished that is not."""

import hashlib
import json
import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from seafoam.files import PART, write_whole
from seafoam.sequences.errors import OtherSequenceError

MANIFEST = "sequence.json"
"""All that the frames' bytes depend on (:meth:`seafoam.sequences.spec.SequenceSpec.identity`)."""
HASHES = "frames.sha256"
"""A line for each finished frame, as ``sha256sum --check`` reads them."""
MANIFEST_VERSION = 1

_FRAME = re.compile(r"frame-(\d{6})\.png")
_LINE = re.compile(r"([0-9a-f]{64})  frame-(\d{6})\.png")


def frame_name(index: int) -> str:
    """Return the file name of a frame."""
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
        """Return the path of a frame."""
        return self.path / frame_name(index)

    def put(self, index: int, content: bytes) -> None:
        """Write a frame, then its hash. Raises ``OSError``."""
        write_whole(self.frame(index), content)
        line = f"{hashlib.sha256(content).hexdigest()}  {frame_name(index)}\n"
        with (self.path / HASHES).open("ab") as file:
            file.write(line.encode())

    def finished(self, count: int) -> set[int]:
        """Return which of the first ``count`` frames are there with the hash that was noted. Reads them all."""
        hashes = self._hashes()
        return {
            index
            for index, noted in hashes.items()
            if index < count and self.frame(index).is_file() and _sha256(self.frame(index)) == noted
        }

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
        """Return the noted hashes; a line that was torn by a crash, the last or one in between, counts for nothing."""
        try:
            text = (self.path / HASHES).read_text(encoding="utf-8", errors="replace")
        except FileNotFoundError:
            return {}
        if text and not text.endswith("\n"):
            with (self.path / HASHES).open("ab") as file:
                file.write(b"\n")
        lines = (_LINE.fullmatch(line) for line in text.splitlines())
        return {int(line[2]): line[1] for line in lines if line}


def _sha256(path: Path) -> str:
    with path.open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()
