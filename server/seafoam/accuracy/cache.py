"""Stores measurements and computed pictures on disk, keyed by everything that they depend on."""

import hashlib
import json
import logging
import os
from pathlib import Path
from typing import Any

from seafoam.files import write_whole

log = logging.getLogger(__name__)


def cache_dir() -> Path:
    """Return ``SEAFOAM_CACHE``, or ``seafoam`` in the user's cache directory (XDG; ``~/.cache``)."""
    if chosen := os.environ.get("SEAFOAM_CACHE"):
        return Path(chosen)
    shared = os.environ.get("XDG_CACHE_HOME", "")
    return (Path(shared) if shared.startswith("/") else Path.home() / ".cache") / "seafoam"


def key_of(*parts: Any) -> str:
    """Return a file name for JSON values."""
    text = json.dumps(parts, sort_keys=True, separators=(",", ":"))
    return hashlib.sha256(text.encode()).hexdigest()[:40]


class Store:
    """A directory of files by key. If it cannot be written to, content is kept in memory."""

    def __init__(self, directory: Path | None = None) -> None:
        self.directory = cache_dir() if directory is None else directory
        self._memory: dict[str, bytes] = {}

    def get(self, kind: str, name: str) -> bytes | None:
        if (held := self._memory.get(f"{kind}/{name}")) is not None:
            return held
        try:
            return (self.directory / kind / name).read_bytes()
        except OSError:
            return None

    def put(self, kind: str, name: str, content: bytes) -> None:
        """Store content under a name. Files appear complete or not at all."""
        try:
            folder = self.directory / kind
            folder.mkdir(parents=True, exist_ok=True)
            write_whole(folder / name, content)
        except OSError as error:
            log.warning(
                "Cannot store measurements in %s (%s): they are kept for the life of this process", folder, error
            )
            self._memory[f"{kind}/{name}"] = content
