"""Reading tiled images: texels, bilinear, trilinear and B-spline, all wrapped; the centre of texel i is (i + ½)/size.

Coordinates u run along columns and v along rows, 1 a tile. Images are (size, size) or (size, size, channels), rows
from v = 0, size a power of two.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike
from scipy.ndimage import map_coordinates

from seafoam.reference.types import Floats, Indices, Ranks
from seafoam.textures.spec import halved

QUANTILE_ENTRIES = 65


def box_chain(image: Floats) -> list[Floats]:
    """The image and its box-averaged halvings down to one texel."""
    return [image, *box_chain(halved(image))] if image.shape[0] > 1 else [image]


def thresholds(ranks: Ranks) -> Floats:
    """m = (rank + ½)/N of each texel, in (0, 1)."""
    return (ranks.astype(np.float64) + 0.5) / ranks.size


def nearest(image: Floats, u: Floats, v: Floats) -> Floats:
    """The texel that (u, v) lies in; (r,) or (r, channels)."""
    size = image.shape[0]
    return texel(image, np.floor(u * size), np.floor(v * size))


def texel(image: Floats, column: Floats, row: Floats) -> Floats:
    """The texels with these integer coordinates; (r,) or (r, channels)."""
    size = image.shape[0]
    return image[_wrapped(row, size), _wrapped(column, size)]


def bilinear(image: Floats, u: Floats, v: Floats) -> Floats:
    """Bilinear between the four nearest texel centres of an image without channels; (r,)."""
    at = v * image.shape[0] - 0.5, u * image.shape[0] - 0.5
    result: Floats = map_coordinates(image, at, np.float64, order=1, mode="grid-wrap")
    return result


def trilinear(chain: Sequence[Floats], u: Floats, v: Floats, level: Floats) -> Floats:
    """Bilinear at the two levels around ``level``, clamped to existing ones, linear between; (r,)."""
    level = np.clip(level, 0.0, len(chain) - 1.0)
    result = np.zeros_like(u)
    for index, image in enumerate(chain):
        weight = np.maximum(1.0 - np.abs(level - index), 0.0)
        here = np.flatnonzero(weight > 0.0)
        result[here] += weight[here] * bilinear(image, u[here], v[here])
    return result


@dataclass(frozen=True)
class SplineSample:
    """A B-spline at r places: value, gradient and second derivatives by u and v (a tile); (r,) each."""

    value: Floats
    u: Floats
    v: Floats
    uu: Floats
    vv: Floats
    uv: Floats

    def along(self, step: Floats) -> Floats:
        """Derivative along steps (r, 2), 1 a tile; (r,)."""
        return self.u * step[:, 0] + self.v * step[:, 1]

    def bend(self, step: Floats) -> Floats:
        """Second derivative along steps (r, 2); (r,)."""
        x, y = step[:, 0], step[:, 1]
        return self.uu * x * x + self.vv * y * y + 2.0 * self.uv * x * y


def bspline(image: Floats, u: Floats, v: Floats) -> SplineSample:
    """Uniform cubic B-spline of texels, no prefilter."""
    size = image.shape[0]
    x, y = u * size - 0.5, v * size - 0.5
    i, j = np.floor(x), np.floor(y)
    across, down = spline(x - i), spline(y - j)
    orders = {"value": (0, 0), "u": (1, 0), "v": (0, 1), "uu": (2, 0), "vv": (0, 2), "uv": (1, 1)}
    sums = {name: np.zeros_like(u) for name in orders}
    for a in range(4):
        row = _wrapped(j + (a - 1.0), size)
        for b in range(4):
            texel = image[row, _wrapped(i + (b - 1.0), size)]
            for name, (by_u, by_v) in orders.items():
                sums[name] += down[by_v][a] * across[by_u][b] * texel
    return SplineSample(**{name: sums[name] * float(size) ** sum(order) for name, order in orders.items()})


def quantile(table: Floats, s: ArrayLike) -> Floats:
    """Q(s): the value below which the B-spline mask is on a share s of the plane; s in [0, 1].

    The 65 entries are at equal steps of √(s/2) up to s = ½ and of 1 − √((1 − s)/2) above, linear between.
    """
    share = np.clip(np.asarray(s, np.float64), 0.0, 1.0)
    upper = share > 0.5
    root = np.sqrt(0.5 * np.where(upper, 1.0 - share, share))
    return np.interp(np.where(upper, 1.0 - root, root), np.linspace(0.0, 1.0, QUANTILE_ENTRIES), table)


def _wrapped(index: Floats, size: int) -> Indices:
    return np.mod(index, size).astype(np.intp)


def spline(f: Floats) -> tuple[list[Floats], list[Floats], list[Floats]]:
    """Weights of texels −1, 0, 1, 2 at the fraction f past texel 0, their first and second derivatives a texel."""
    g = 1.0 - f
    outer, inner = f * f * f / 6.0, 2.0 / 3.0 - 0.5 * f * f * (2.0 - f)
    weights = [g * g * g / 6.0, inner, 2.0 / 3.0 - 0.5 * g * g * (2.0 - g), outer]
    rates = [-0.5 * g * g, 0.5 * f * (3.0 * f - 4.0), 0.5 * g * (4.0 - 3.0 * g), 0.5 * f * f]
    return weights, rates, [g, 3.0 * f - 2.0, 3.0 * g - 2.0, f]
