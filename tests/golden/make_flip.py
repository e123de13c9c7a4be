"""Write ``flip.json``: pictures of linear light and their mean FLIP, which the web client must give too.

python tests/golden/make_flip.py
"""

import json
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from seafoam.accuracy import metrics
from seafoam.scene.light import ToneCurve

WIDTH, HEIGHT = 40, 24
CURVES: tuple[ToneCurve | None, ...] = (None, "filmic", "photographic")


def pictures() -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """A reference with smooth colours, edges and light above white, and a picture that differs in all of them."""
    y, x = np.mgrid[0:HEIGHT, 0:WIDTH]
    stripes = (np.sin(x * 0.9) > 0.3) * 0.6
    truth = np.stack((0.1 + x / WIDTH, 0.3 + 0.2 * np.cos(y / 3.0), 0.05 + y / HEIGHT + stripes), axis=-1)
    picture = truth + np.stack((0.1 * (y > 12), 0.05 * np.sin(x * y / 7.0), -0.3 * (x > 20) * (y > 6)), axis=-1)
    return np.round(np.maximum(truth, 0.0), 3), np.round(np.maximum(picture, 0.0), 3)


def main() -> None:
    """Write the file beside this one."""
    truth, picture = pictures()
    values = {"none" if curve is None else curve: round(metrics.flip(picture, truth, curve), 6) for curve in CURVES}
    golden = {"width": WIDTH, "height": HEIGHT, "flip": values}
    golden |= {"truth": truth.ravel().tolist(), "picture": picture.ravel().tolist()}
    Path(__file__).with_name("flip.json").write_text(json.dumps(golden) + "\n")


if __name__ == "__main__":
    main()
