"""Stores measurements and computed pictures on disk, keyed by everything that they depend on."""

import hashlib
import json
import os
from pathlib import Path
from typing import Any

from seafoam.render.service.frame_cache import DiskCache

LIMIT = 1 << 30
"""Bytes on disk, the oldest of which go first."""


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


def stored(directory: Path | None = None) -> DiskCache:
    """Return the measurements and pictures of a cache directory, by default of :func:`cache_dir`."""
    return DiskCache((directory or cache_dir()) / "accuracy", LIMIT)
