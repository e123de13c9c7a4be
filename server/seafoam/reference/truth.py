"""Baked reference frames on disk: one compressed .npz file each, the same bytes for the same frame.

Linear RGB is held to [0, 4] and stored as round(65535 √(x/4)): its error is below 0.01/255 at white and less in the
dark. Alpha is round(65535 a). Values are stored as differences along rows, high and low bytes apart.
"""

import hashlib
import io
import json
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from seafoam.reference.renderer.frame import ReferenceFrame
from seafoam.reference.renderer.state import Mode
from seafoam.reference.types import Bools, Floats
from seafoam.scene.base import non_defaults
from seafoam.scene.models import Scene

BRIGHTEST = 4.0
LEVELS = 65535


@dataclass(frozen=True, eq=False)
class Truth:
    """A baked frame, rows from the top."""

    rgb: Floats
    """(H, W, 3) linear RGB in [0, 4]."""
    alpha: Floats
    """(H, W) mean foam amount in [0, 1]."""
    foam: Bools | None
    """(H·n, W·n), where a sample has foam; None in converged mode."""
    preset: str
    look: str | None
    """The foam's look; None without foam."""
    scene_sha256: str
    time: float
    samples: int
    mode: Mode
    seconds: float
    """How long it took to render."""
    numpy: str
    """Version of NumPy that rendered it."""


def scene_sha256(scene: Scene) -> str:
    """SHA-256, in hexadecimal, of the settled scene's :func:`~seafoam.scene.base.non_defaults`, as canonical JSON.

    A new field of the schema does not invalidate baked frames. A changed default does: bake with ``--force``.
    """
    text = json.dumps(non_defaults(scene.settled), sort_keys=True, separators=(",", ":"), allow_nan=False)
    return hashlib.sha256(text.encode()).hexdigest()


def truth_bytes(frame: ReferenceFrame, *, preset: str, scene: Scene, time: float, mode: Mode, seconds: float) -> bytes:
    """Return a frame as the content of its file."""
    rgb = np.rint(LEVELS * np.sqrt(np.clip(frame.rgb, 0.0, BRIGHTEST) / BRIGHTEST)).astype(np.uint16)
    alpha = np.rint(LEVELS * np.clip(frame.alpha, 0.0, 1.0)).astype(np.uint16)
    meta = {
        "preset": preset,
        "look": None if scene.foam is None else scene.foam.look,
        "scene_sha256": scene_sha256(scene),
        "time": time,
        "height": int(alpha.shape[0]),
        "width": int(alpha.shape[1]),
        "samples": frame.samples,
        "mode": mode,
        "seconds": round(seconds, 1),
        "numpy": np.__version__,
    }
    arrays: dict[str, NDArray[np.uint8]] = {
        "meta": np.frombuffer(json.dumps(meta, sort_keys=True).encode(), np.uint8),
        "rgb": _planes(rgb),
        "alpha": _planes(alpha[:, :, None]),
    }
    if mode == "same-samples":
        arrays["foam"] = np.packbits(frame.amount > 0.0, axis=1)
    # The keywords of savez_compressed are array names, which the type of its one option hides.
    buffer = io.BytesIO()
    np.savez_compressed(buffer, **arrays)  # type: ignore[arg-type]
    return buffer.getvalue()


def load_truth(path: Path) -> Truth:
    """Read a file of :func:`truth_bytes`. Raises ``OSError``, ``KeyError`` or ``ValueError`` for another file."""
    with np.load(path, allow_pickle=False) as stored:
        meta = json.loads(stored["meta"].tobytes())
        rgb = _joined(stored["rgb"]).astype(np.float64)
        alpha = _joined(stored["alpha"])[:, :, 0].astype(np.float64)
        foam = None
        if "foam" in stored:
            foam = np.unpackbits(stored["foam"], axis=1, count=meta["width"] * meta["samples"]).astype(np.bool_)
    described = {name: value for name, value in meta.items() if name not in ("width", "height")}
    return Truth(rgb=BRIGHTEST * (rgb / LEVELS) ** 2, alpha=alpha / LEVELS, foam=foam, **described)


def truth_is_current(path: Path, scene: Scene) -> bool:
    """Whether a file holds a frame of exactly this scene; False where there is no file."""
    if not path.is_file():
        return False
    with np.load(path, allow_pickle=False) as stored:
        recorded: str = json.loads(stored["meta"].tobytes())["scene_sha256"]
    return recorded == scene_sha256(scene)


def _planes(values: NDArray[np.uint16]) -> NDArray[np.uint8]:
    """Differences along rows of (H, W, C), modulo 2¹⁶, as (2, C, H, W) bytes: high, then low."""
    moved = np.moveaxis(values, 2, 0)
    steps = np.diff(moved, axis=2, prepend=np.uint16(0))
    return np.stack(((steps >> 8).astype(np.uint8), (steps & 255).astype(np.uint8)))


def _joined(planes: NDArray[np.uint8]) -> NDArray[np.uint16]:
    """Inverse of :func:`_planes`."""
    steps = (planes[0].astype(np.uint16) << 8) | planes[1]
    return np.moveaxis(np.cumsum(steps, axis=2, dtype=np.uint16), 0, 2)
