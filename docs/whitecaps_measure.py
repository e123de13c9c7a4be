"""Whitecaps counted in photographs, as oceanographers count them: Automated Whitecap Extraction (AWE).

Callaghan and White (2009), "Automated Processing of Sea Surface Images for the Determination of Whitecap Coverage",
J. Atmos. Oceanic Technol. 26, 383-394, doi:10.1175/2008JTECHO634.1. Nothing here knows how the pictures were made.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import find_objects, label
from scipy.signal import butter, filtfilt

Floats = NDArray[np.float64]
Rule = Literal["program", "least"]

LUMINANCE = (0.2989, 0.5870, 0.1140)
"""Weights of R, G and B (ITU-R BT.601) of the encoded channels: what cameras' pictures are made grey by."""
STEP = 2.0 / 255.0
"""From threshold to threshold. A whole number of 8-bit levels: others let now two, now three levels in."""
CUT = 0.16
"""Cut-off of the Butterworth filter over the smallest wavelength that the steps hold."""
ORDER = 4
RUN = 4
"""Points of the running mean over the first derivative."""
LEAST_RISE = 3.0
"""PIP rises by so many percentage points where the water comes in; less is a picture of water alone."""
LEAST_STEPS = 24
"""Fewer thresholds than that between the brightest and the darkest pixel are too few to differentiate."""


def grey(picture: NDArray[Any]) -> Floats:
    """A picture of an 8-bit or real RGB display signal as grey, (height, width) in [0, 1].

    picture: (height, width, ≥ 3), uint8 or real in [0, 1], sRGB-encoded as cameras give it. Raises ``ValueError`` for
    another shape.
    """
    if picture.ndim != 3 or picture.shape[2] < 3:
        raise ValueError(f"a picture must be (height, width, 3), not {picture.shape}")
    encoded = picture[..., :3].astype(np.float64)
    if picture.dtype == np.uint8:
        encoded /= 255.0
    result: Floats = encoded @ np.array(LUMINANCE)
    return result


def levelled(picture: NDArray[Any]) -> Floats:
    """A picture's grey, or its blue where that slopes less, without the slope of its rows: (height, width) in [0, 1].

    Water is brighter toward the horizon, where it mirrors more. As the first author's later program prepares pictures:
    a line is fitted through the rows' means, and each row divided by the line there over the line in the middle; what
    exceeds white is white. picture: as :func:`grey` takes it. Raises ``ValueError`` as that does.
    """
    own = grey(picture)
    blue = picture[..., 2] / 255.0 if picture.dtype == np.uint8 else picture[..., 2].astype(np.float64)
    rows = np.arange(own.shape[0], dtype=np.float64)
    fits = [(np.polyfit(rows, channel.mean(axis=1), 1), channel) for channel in (own, blue)]
    fit, chosen = min(fits, key=lambda candidate: abs(float(candidate[0][0])))
    # A line that falls to nothing within the picture would divide by nothing.
    line = np.maximum(np.polyval(fit, rows), 1e-3)
    result: Floats = np.minimum(chosen * (line[rows.size // 2] / line)[:, None], 1.0)
    return result


@dataclass(frozen=True)
class Curve:
    """What AWE reads a threshold from: thresholds falling from the brightest pixel on, and what each lets in."""

    thresholds: Floats
    """In the picture's unit, falling by :data:`STEP`."""
    pip: Floats
    """Percentage increase in pixels, smoothed, %."""
    slope: Floats
    """Its first derivative by falling threshold, smoothed, % a step."""


def pip_curve(image: NDArray[Any]) -> Curve | None:
    """The percentage increase in pixels (PIP) of a grey picture and its derivatives; None where it has no contrast.

    image: (height, width) in [0, 1] or uint8. PIP_i = 100 (N_i − N_{i−1})/N_i, N_i the pixels brighter than the i-th
    threshold (Callaghan and White 2009; the equation as in the program that the first author gave away later, the
    printed one was not at hand). It is smoothed by a Butterworth filter of fourth order forward and backward, its
    derivative by a running mean of four points, as there. Raises ``ValueError`` for another shape, for values outside
    [0, 1] and for values that are not finite.
    """
    values = _checked(image)
    top = float(values.max())
    steps = int((top - float(values.min())) / STEP)
    if steps < LEAST_STEPS:
        return None
    # Half a level under a level, so that rounding decides nothing.
    thresholds: Floats = (top - STEP * (np.arange(steps) + 0.75)).astype(np.float64)
    first = np.minimum(np.ceil((top - values.ravel()) / STEP - 0.75), steps).astype(np.int64)
    counts = np.cumsum(np.bincount(np.maximum(first, 0), minlength=steps))[:steps]
    pip = 100.0 * np.diff(counts) / counts[1:]
    smooth: Floats = filtfilt(*butter(ORDER, CUT), pip, padlen=min(20, len(pip) - 1))
    rough = np.pad(np.gradient(smooth), (RUN // 2, RUN - 1 - RUN // 2), mode="edge")
    slope: Floats = np.convolve(rough, np.full(RUN, 1.0 / RUN), "valid").astype(np.float64)
    return Curve(thresholds[1:], smooth, slope)


def awe_threshold(image: NDArray[Any], rule: Rule = "program") -> float | None:
    """The grey above which pixels are whitecap, as a share of white; None: no whitecap.

    image: (height, width) grey, real in [0, 1] or uint8. As the threshold falls PIP first drops from the few brightest
    pixels on, lies low where it goes through the whitecaps, and rises where the water comes in. The steepest rise is
    the greatest maximum of the first derivative. ``program``: the threshold is the last place before it (at higher
    thresholds) where that derivative is least, or, where PIP still falls there, PIP's minimum after it; the order of
    rules of the first author's later program. ``least``: the least PIP before the steepest rise, a stricter reading.

    Ours: a picture whose PIP rises by less than :data:`LEAST_RISE` is one of water alone. Source: Callaghan and White
    (2009), the derivative analysis. Raises ``ValueError`` as :func:`pip_curve` does.
    """
    curve = pip_curve(image)
    if curve is None:
        return None
    steepest = int(np.argmax(curve.slope))
    if rule == "least":
        chosen = int(np.argmin(curve.pip[: steepest + 1]))
    else:
        troughs = _minima(curve.slope[: steepest + 1])
        if not troughs:
            return None
        chosen = troughs[-1]
        if curve.slope[chosen] < 0.0:
            chosen += int(np.flatnonzero(curve.slope[chosen : steepest + 1] >= 0.0)[0])
    if float(curve.pip[chosen : steepest + RUN].max()) - float(curve.pip[chosen]) < LEAST_RISE:
        return None
    return float(curve.thresholds[chosen])


def awe_coverage(images: Sequence[NDArray[Any]], rule: Rule = "program") -> Floats:
    """Share of each picture that AWE counts as whitecap, (number,) in [0, 1]; 0 where it finds none.

    images: grey, each (height, width), real in [0, 1] or uint8; rule: of :func:`awe_threshold`. Raises ``ValueError``
    as :func:`pip_curve` does.
    """
    shares = []
    for image in images:
        threshold = awe_threshold(image, rule)
        shares.append(0.0 if threshold is None else float(np.mean(_checked(image) > threshold)))
    return np.array(shares, np.float64)


@dataclass(frozen=True)
class Patches:
    """Connected patches of foam, one entry each; 8-connected, none that touches the picture's edge."""

    areas: Floats
    """m²."""
    lengths: Floats
    """Extent along the longest axis of inertia, m."""
    perimeters: Floats
    """Sides of pixels between foam and water, m."""

    @property
    def axis_ratios(self) -> Floats:
        """Short over long axis of the ellipse of the same area and length, 4A/(πL²): 1 for a disc."""
        result: Floats = 4.0 * self.areas / (np.pi * self.lengths**2)
        return result

    def dimension(self) -> float:
        """Fractal dimension D of the outlines from P ∝ A^(D/2) (Mandelbrot; Lovejoy 1982): 1 smooth, 2 fills a plane.

        Raises ``ValueError`` for fewer than three patches.
        """
        if len(self.areas) < 3:
            raise ValueError(f"{len(self.areas)} patches have no dimension")
        return 2.0 * float(np.polyfit(np.log(self.areas), np.log(self.perimeters), 1)[0])

    def exponent(self) -> float:
        """Exponent n of the density of areas, p(A) ∝ A^−n above the least, by maximum likelihood (Hill's estimator).

        Raises ``ValueError`` for fewer than three patches or areas that are all alike.
        """
        logs = np.log(self.areas / self.areas.min()) if len(self.areas) >= 3 else np.zeros(1)
        if logs.mean() <= 0.0:
            raise ValueError("too few patches, or all of one size")
        return 1.0 + 1.0 / float(logs.mean())


def patches(foam: NDArray[np.bool_], pixel: float, least: int = 16) -> Patches:
    """The patches of a picture from straight above.

    foam: (height, width); pixel: its side, m, above 0; least: pixels of the smallest patch that is counted, at least
    1. Raises ``ValueError`` where that is not so.
    """
    if foam.ndim != 2 or not pixel > 0.0 or least < 1:
        raise ValueError("patches need a picture (height, width), and a pixel size and a minimum size above 0")
    names, count = label(foam, structure=np.ones((3, 3)))
    edge = np.unique(np.concatenate([names[0], names[-1], names[:, 0], names[:, -1]]))
    sizes = np.bincount(names.ravel(), minlength=count + 1)
    areas, lengths, perimeters = [], [], []
    for name, box in enumerate(find_objects(names), start=1):
        if sizes[name] < least or name in edge:
            continue
        shape = np.pad(names[box] == name, 1)
        places = np.argwhere(shape).astype(np.float64)
        _, axes = np.linalg.eigh(np.atleast_2d(np.cov(places.T)))
        along = places @ axes[:, -1]
        areas.append(sizes[name] * pixel**2)
        lengths.append((float(np.ptp(along)) + 1.0) * pixel)
        sides = sum(int(np.count_nonzero(np.diff(shape.astype(np.int8), axis=axis))) for axis in (0, 1))
        perimeters.append(sides * pixel)
    return Patches(np.array(areas), np.array(lengths), np.array(perimeters))


def _checked(image: NDArray[Any]) -> Floats:
    if image.ndim != 2 or image.size == 0:
        raise ValueError(f"a grey picture must be (height, width), not {image.shape}")
    values: Floats = image.astype(np.float64)
    if image.dtype == np.uint8:
        values /= 255.0
    if not bool(np.isfinite(values).all()) or values.min() < 0.0 or values.max() > 1.0:
        raise ValueError("a grey picture must lie in [0, 1]")
    return values


def _minima(values: Floats) -> list[int]:
    """Places of the local minima inside, in order."""
    inner = (values[1:-1] <= values[:-2]) & (values[1:-1] < values[2:])
    return [int(i) + 1 for i in np.flatnonzero(inner)]
