"""Contact sheets of docs/second-look.md: presets at three times, as they were in an older checkout and as they are.

git worktree add /tmp/before 2766c9bf
.venv/bin/python docs/looks/make_second_look.py /tmp/before [PRESET ...]
.venv/bin/python docs/looks/make_second_look.py --motion FOLDER [FOLDER ...]

The second draws what time does to a column of each folder's frames (a directory of ``seafoam sequence``), and says by
how many levels frames differ from the one before, and where most.
"""

import os
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image

sys.path.append(str(Path(__file__).resolve().parents[2]))
from docs.make_pictures import PICTURES, sheet

HERE = Path(__file__).resolve().parents[2]
PRESETS = Path("server/seafoam/scene/presets")
TIMES = {
    "open-ocean": (28.0, 31.0, 36.0),
    "storm": (44.0, 47.0, 52.0),
    "boat-in-storm": (10.0, 30.0, 50.0),
    "explosion": (0.2, 3.2, 14.2),
    "spray-on-rocks": (1.3, 4.3, 9.3),
    "lake-sunset": (5.0, 8.0, 13.0),
    "river": (6.0, 9.0, 14.0),
    "breaker": (6.8, 7.6, 11.0),
}
"""Of each preset, s: its own and two later ones."""
SIZE = "480x270"
MOST = 200_000
"""Bytes of a sheet: [tool.seafoam.budget.kB]."""
SLICE = (480, 270)


def drawn(checkout: Path, name: str, folder: Path) -> list[Image.Image]:
    """The preset at its times as the command of a checkout draws it; none where the checkout lacks it."""
    if not (checkout / PRESETS / f"{name}.json").exists():
        return []
    pictures = []
    for time in TIMES[name]:
        file = folder / f"{checkout.name}-{name}-{time:g}.png"
        command = [
            str(Path(sys.executable).with_name("seafoam")),
            "render",
            name,
            "--time",
            f"{time:g}",
            "--size",
            SIZE,
        ]
        environment = os.environ | {"PYTHONPATH": str(checkout / "server")}
        subprocess.run(
            [*command, "-o", str(file)], env=environment, cwd=checkout, check=True, stdout=subprocess.DEVNULL
        )
        with Image.open(file) as picture:
            pictures.append(picture.convert("RGB"))
    return pictures


def write(name: str, picture: Image.Image) -> None:
    """Write a WebP as good as its budget allows."""
    file = PICTURES / f"second-look-{name}.webp"
    for quality in range(88, 40, -6):
        picture.save(file, quality=quality, method=6)
        if file.stat().st_size < MOST:
            break


def frames(folder: Path) -> NDArray[np.uint8]:
    """A sequence's frames, (n, height, width, 3)."""
    found = []
    for file in sorted(folder.glob("frame-*.png")):
        with Image.open(file) as picture:
            found.append(np.asarray(picture.convert("RGB")))
    return np.stack(found)


def slice_of(folder: Path) -> Image.Image:
    """The middle column of a sequence, time to the right; and its differences, printed."""
    film = frames(folder)
    grey = film.astype(np.float32).mean(axis=-1)
    steps = np.abs(np.diff(grey, axis=0)).mean(axis=(1, 2))
    # What goes on as before leaves nothing of this; what comes and goes from frame to frame leaves all.
    flicker = np.abs(grey[1:-1] - 0.5 * (grey[:-2] + grey[2:])).mean(axis=(1, 2))
    light = np.abs(np.diff(grey.mean(axis=(1, 2)))).max()
    print(
        f"{folder.name}: {len(film)} frames; levels from frame to frame: median {np.median(steps):.2f},"
        f" most {steps.max():.2f} at {steps.argmax() + 1}; from the mean of both neighbours:"
        f" median {np.median(flicker):.2f}, most {flicker.max():.2f} at {flicker.argmax() + 1}; mean: most {light:.2f}"
    )
    column = np.ascontiguousarray(film[:, :, film.shape[2] // 2].transpose(1, 0, 2))
    return Image.fromarray(column).resize(SLICE, Image.Resampling.BILINEAR)


def main(first: str, others: list[str]) -> None:
    """Write the sheets of all presets or of those named, or the slices of sequences."""
    if first == "--motion":
        write("motion", sheet([slice_of(Path(folder)) for folder in others], 3))
        return
    with tempfile.TemporaryDirectory() as folder:
        for name in others or TIMES:
            pictures = [*drawn(Path(first).resolve(), name, Path(folder)), *drawn(HERE, name, Path(folder))]
            write(name, sheet(pictures, len(TIMES[name])))
            print(name, flush=True)


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2:])
