"""A bounded cache of bytes on disk, which never answers with anything else than what was put in.

Why no library: diskcache, the best kept one, holds its entries in SQLite and pickles. It has no checksum, a full disk
raises from reads and writes and leaves files that its index does not know (its issue 112), a torn database makes all
entries unusable (67), and reading a pickle runs what is in it. Here every entry is one file of plain bytes.
"""

import contextlib
import hashlib
import logging
import os
import threading
import time
from pathlib import Path

from seafoam import files

log = logging.getLogger(__name__)

_MAGIC = b"seafoam1"
_DIGEST = 32
_HEADER = len(_MAGIC) + _DIGEST
_BLOCK = 4096
"""Files occupy whole blocks of most file systems, bytes."""
_KEPT_SHARE = 0.9
"""Share of the limit that eviction leaves, so that it does not run at every write."""
ABANDONED_SECONDS = 3600.0
"""Age of a temporary file whose writer must have died, s."""
PAUSE_SECONDS = 60.0
"""Time without writes after one failed, s: a full disk does not empty sooner, and is not made worse."""


class DiskCache:
    """Files by key in a directory, at most ``limit`` bytes in all; the least recently read ones go first.

    Each file holds the SHA-256 of its content, and appears under its name complete or not at all. A file whose content
    does not match is removed and counts as absent. Nothing raises: a cache that cannot be read or written is empty.
    Several processes may share the directory. Thread-safe.
    """

    def __init__(self, directory: Path, limit: int) -> None:
        self.directory = directory
        self.limit = limit
        self.damaged = 0
        """Files that were removed because their content did not match."""
        self.failures = 0
        """Writes that failed."""
        self._lock = threading.Lock()
        self._total: int | None = None
        """Bytes on disk as far as known; None: not counted yet."""
        self._paused_until = 0.0

    def get(self, key: str) -> bytes | None:
        """Return the content stored under a key (letters, digits, ``-``), or None."""
        path = self._path(key)
        try:
            stored = path.read_bytes()
        except OSError:
            return None
        content = stored[_HEADER:]
        if stored[:_HEADER] != _MAGIC + hashlib.sha256(content).digest():
            self.damaged += 1
            log.warning("A file of the cache was damaged, and is removed: %s", path)
            _remove(path)
            return None
        with contextlib.suppress(OSError):
            os.utime(path)  # the order of eviction
        return content

    def put(self, key: str, content: bytes) -> bool:
        """Store content under a key, and evict what no longer fits. Returns whether it was stored."""
        size = _blocks(_HEADER + len(content))
        if size > self.limit or time.monotonic() < self._paused_until:
            return False
        try:
            self._write(self._path(key), content)
        except OSError as error:
            self.failures += 1
            self._paused_until = time.monotonic() + PAUSE_SECONDS
            log.warning("The cache in %s cannot be written, and rests for a minute: %s", self.directory, error)
            return False
        with self._lock:
            self._total = None if self._total is None else self._total + size
            if self._total is None or self._total > self.limit:
                self._evict()
        return True

    def _path(self, key: str) -> Path:
        # Folders of a few hundred files: listing one folder of a million is slow on some file systems.
        return self.directory / key[:2] / key

    def _write(self, path: Path, content: bytes) -> None:
        path.parent.mkdir(parents=True, exist_ok=True)
        with files.whole(path) as part, part.open("wb") as file:
            file.write(_MAGIC + hashlib.sha256(content).digest())
            file.write(content)
            file.flush()
            # A loss of power must not leave the name without the content. The folder need not be synchronised:
            # a name that is lost is a frame drawn again.
            os.fsync(file.fileno())

    def _evict(self) -> None:
        """Count what is there, other processes' files too, and remove the oldest until it fits."""
        entries: list[tuple[float, int, str]] = []
        now = time.time()
        for folder in _listed(self.directory):
            for file in _listed(Path(folder.path)):
                try:
                    stat = file.stat()
                except OSError:
                    continue
                if not file.name.startswith(files.PART):
                    entries.append((stat.st_mtime, _blocks(stat.st_size), file.path))
                elif now - stat.st_mtime > ABANDONED_SECONDS:
                    _remove(Path(file.path))
        total = sum(size for _, size, _ in entries)
        if total > self.limit:
            for _, size, path in sorted(entries):
                if total <= _KEPT_SHARE * self.limit:
                    break
                _remove(Path(path))
                total -= size
        self._total = total


def _blocks(size: int) -> int:
    return -(-size // _BLOCK) * _BLOCK


def _listed(directory: Path) -> list[os.DirEntry[str]]:
    try:
        with os.scandir(directory) as entries:
            return list(entries)
    except OSError:
        return []


def _remove(path: Path) -> None:
    with contextlib.suppress(OSError):
        path.unlink()
