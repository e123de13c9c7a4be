"""What was measured in nature, with its scatter: the bands of docs/nature.md. Winds are those at 10 m, m/s."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from docs.nature.measure import equivalent_width, glitter, path_view

from seafoam.ocean.constants import GRAVITY
from seafoam.ocean.foam.whitecaps import whitecaps
from seafoam.scene import direction

SCATTER = math.sqrt(10.0)
"""Of whitecap coverage to either side: recent sets that were measured alike scatter by a factor of about 10."""
DEVIATIONS = 2.0
"""Of Cox and Munk's slopes about their lines that a band has to either side: 95 % of what they measured."""
AGE = 1.2
"""Phase speed of a fully developed sea's longest waves over the wind; faster waves are swell."""

COVERAGE = (
    "Monahan and O'Muircheartaigh 1980, W = 3.84e-6 U^3.41; Callaghan et al. 2008, two cubics; either, times or over "
    "√10 (Callaghan et al. 2012: a factor of 10 in all)"
)
SLOPES = "Cox and Munk 1954, regression on wind, two standard deviations"
GROWTH = (
    "least of Hasselmann et al. 1973, Kahma and Calkoen 1992 (stable, unstable) and Resio et al. 2003, to full growth "
    "by the last or by Pierson and Moskowitz 1964"
)


@dataclass(frozen=True)
class Quantity:
    """What is compared: its title, unit and source, and the factor from SI to that unit."""

    title: str
    unit: str
    source: str
    scale: float = 1.0


@dataclass(frozen=True)
class Row:
    """A quantity of a preset beside nature's band, in the quantity's unit."""

    key: str
    preset: str
    ours: float
    low: float
    high: float

    @property
    def side(self) -> str:
        """Whether it lies ``within`` the band, ``below`` or ``above`` it."""
        return "below" if self.ours < self.low else "above" if self.ours > self.high else "within"


QUANTITIES: dict[str, Quantity] = {
    "above": Quantity("foam from above", "%", COVERAGE, 100.0),
    "own": Quantity("foam, own camera, mean of 8 times", "%", COVERAGE, 100.0),
    "up": Quantity("slope variance along the wind", "", SLOPES + ": 3.16e-3 U ± 0.004"),
    "across": Quantity("slope variance across it", "", SLOPES + ": 0.003 + 1.92e-3 U ± 0.002"),
    "path": Quantity("width of the glitter's path", "°", SLOPES + "; geometry of their glitter", 180.0 / math.pi),
    "dense": Quantity(
        "reflectance of full foam", "", "Whitlock et al. 1982, Koepke 1984: 0.55; Dierssen 2019: 0.40; to 0.60"
    ),
    "effective": Quantity("effective reflectance of whitecaps", "", "Koepke 1984: 0.22 ± 0.11"),
    "decay": Quantity("decay time of patches, median", "s", "Callaghan et al. 2012: 0.5 to 8 s"),
    "set": Quantity("decay time that the scene sets", "s", "Monahan and Zietlow 1969: 2.5 s fresh, 3.9 s salt water"),
    "height": Quantity("significant height", "m", GROWTH),
    "period": Quantity("peak period", "s", GROWTH),
    "steepness": Quantity("significant steepness", "", "DNV-RP-C205: at most 1/15 to 8 s, 1/25 from 15 s"),
}


def callaghan(wind: float) -> float:
    """Whitecap coverage (Callaghan et al. 2008): cubics for winds to 11.25 and from 9.25 m/s, changed half way."""
    percent = 3.18e-3 * max(wind - 3.70, 0.0) ** 3 if wind < 10.25 else 4.82e-4 * (wind + 1.98) ** 3
    return percent / 100.0


def coverage_band(wind: float) -> tuple[float, float]:
    """Least and greatest share of whitecaps."""
    laws = whitecaps(wind), callaghan(wind)
    return min(laws) / SCATTER, max(laws) * SCATTER


def slope_bands(wind: float) -> tuple[tuple[float, float], tuple[float, float]]:
    """Least and greatest variance of slopes along and across the wind; the least positive, as a surface needs."""
    lines = ((3.16e-3 * wind, 0.004), (0.003 + 1.92e-3 * wind, 0.002))
    along, across = ((max(mean - DEVIATIONS * off, 5e-4), mean + DEVIATIONS * off) for mean, off in lines)
    return along, across


def growth(wind: float, fetch: float) -> tuple[tuple[float, float], tuple[float, float]]:
    """Least and greatest significant height, m, and peak period, s, from this fetch to a fully developed sea."""
    over = GRAVITY * fetch / wind**2
    energies = 1.6e-7 * over, 9.3e-7 * over**0.76, 5.4e-7 * over**0.94
    frequencies = 2.0 * math.pi * 3.5 * over**-0.33, 12.0 * over**-0.24, 14.2 * over**-0.28
    # The Coastal Engineering Manual has the wind's friction velocity squared.
    stress = 0.001 * (1.1 + 0.035 * wind) * wind**2
    beyond, aloft = GRAVITY * fetch / stress, 1.026 * wind
    full_height = max(0.21 * aloft**2, 211.5 * stress) / GRAVITY
    full_period = max(2.0 * math.pi / 0.877 * aloft, 239.8 * math.sqrt(stress)) / GRAVITY
    heights = [4.0 * math.sqrt(energy) * wind**2 / GRAVITY for energy in energies]
    heights.append(0.0413 * math.sqrt(beyond) * stress / GRAVITY)
    periods = [2.0 * math.pi * wind / GRAVITY / frequency for frequency in frequencies]
    periods.append(0.651 * beyond ** (1.0 / 3.0) * math.sqrt(stress) / GRAVITY)
    return (min(*heights, full_height), full_height), (min(*periods, full_period), full_period)


def steepest(period: float) -> float:
    """Greatest significant steepness 2π H/(g T²) of a sea state, by its peak period, s."""
    return float(np.interp(period, (8.0, 15.0), (1.0 / 15.0, 1.0 / 25.0)))


def path_band(figure: Mapping[str, Any]) -> tuple[float, float]:
    """Least and greatest width of the glitter's path toward the preset's lamp, rad, by Cox and Munk's equation."""
    lamp = figure["lamp"]
    view = path_view(lamp)[1]
    bands = slope_bands(figure["wind"])
    least, greatest = (
        equivalent_width(glitter(view, direction(*lamp), figure["heading"], [band[end] for band in bands]), view, lamp)
        for end in (0, 1)
    )
    return least, greatest


def rows(figures: Mapping[str, Mapping[str, Any]]) -> list[Row]:
    """Every measured quantity of every preset that nature has a band for, by quantity.

    Heights and periods are compared where wind raises the waves: where they are no faster than it lets them be.
    """
    found = []
    for preset, figure in figures.items():
        wind = figure["wind"]
        along, across = slope_bands(wind)
        bands: dict[str, tuple[float, float]] = {
            "above": coverage_band(wind),
            "own": coverage_band(wind),
            "dense": (0.40, 0.60),
            "effective": (0.11, 0.33),
            "decay": (0.5, 8.0),
            "set": (2.5, 3.9),
            "steepness": (0.0, steepest(figure["period"])),
            "up": along,
            "across": across,
        }
        if figure["fetch"] is not None and GRAVITY * figure["period"] / (2.0 * math.pi) < AGE * wind:
            bands["height"], bands["period"] = growth(wind, figure["fetch"])
        if "path" in figure:
            bands["path"] = path_band(figure)
        for key, (low, high) in bands.items():
            if key in figure:
                scale = QUANTITIES[key].scale
                found.append(Row(key, preset, scale * figure[key], scale * low, scale * high))
    order = list(QUANTITIES)
    return sorted(found, key=lambda row: order.index(row.key))
