"""Section 12: the sun's reflection divided into sparkles, at one time; its mean is the smooth reflection."""

import math
from fractions import Fraction
from functools import partial
from itertools import product

import numpy as np

from seafoam.reference.light.light import Air, Glint, blinn_phong, glint
from seafoam.reference.noise import chained, number, pcg, share
from seafoam.reference.types import Floats, dot, smoothstep
from seafoam.scene import Light, Sparkles

EPOCHS = 65536
MOST = 0.25  # greatest radius, rad
PIXELS = 0.75  # least radius, in sample spacings at the centre of the picture
LIGHT_LEAST = 1e-20
SOFT, SOFT_LEAST = 0.25, 1e-3  # half the width of the ramp around a probability, over the probability


class SparkleField:
    """The sparkles at a time (s). ``step``: sample spacing at the centre of the picture, rad; 0: no least size."""

    def __init__(self, sparkles: Sparkles, time: float, step: float) -> None:
        self.sparkles = sparkles
        lives = Fraction(time) / Fraction(sparkles.life)
        whole = math.floor(lives)
        # Number of whole lives since time 0, modulo EPOCHS, and the fraction of the current one.
        self.epoch, self.turn = whole % EPOCHS, float(lives - whole)
        radius_set = 0.5 * sparkles.size
        self.radius = min(max(PIXELS * step, radius_set), MOST)  # of a sparkle, rad
        # Active sparkles per steradian at w = 1.
        self.density = math.pi * sparkles.rate * (180.0 / math.pi) ** 2 * sparkles.life
        doubled = math.ceil(math.log2(self.radius / radius_set) - 1e-3)
        self.side = 4.0 * radius_set * 2.0**doubled  # of a cell on the octahedron

    def light(self, d: Floats, w: Floats) -> Floats:
        """Radiance of the sparkles toward −d (r, 3) over the sun's irradiance, for a smooth glint w (r,); (r,)."""
        q = d * np.where(d[:, 1:2] < 0.0, [[1.0, -1.0, 1.0]], 1.0)
        folded = q[:, [0, 2]] / (np.abs(q).sum(axis=1, keepdims=True) * self.side)
        first = np.floor(folded - 0.5)
        total = np.zeros_like(w)
        for corner in product((0.0, 1.0), repeat=2):
            total += self._one(q, w, first + corner)
        return total

    def _one(self, q: Floats, w: Floats, cell: Floats) -> Floats:
        own = chained(0, *cell.T)
        age = self.turn + number(own, 0)
        passed = np.floor(age)
        word = pcg(own ^ ((self.epoch + passed.astype(np.int64)) % EPOCHS).astype(np.uint64))
        s = age - passed
        inside = np.stack([number(word, k) for k in (1, 2)], axis=-1)
        centre = (cell + inside) * self.side
        C = np.stack((centre[:, 0], 1.0 - np.abs(centre).sum(axis=1), centre[:, 1]), axis=-1)
        length = np.sqrt(dot(C, C))
        away = q - C / length[:, None]
        shape = np.maximum(1.0 - dot(away, away) / self.radius**2, 0.0) ** 2
        solid = self.side**2 / length**3
        mean = math.pi * self.radius**2 / 3.0
        chance = np.minimum(self.density * w * solid, 1.0)
        soft = np.maximum(np.minimum(SOFT * chance, 1.0 - chance), SOFT_LEAST * chance)
        lit = np.clip(0.5 + 0.5 * (chance - share(word)) / soft, 0.0, 1.0)
        swell = 30.0 * (s * (1.0 - s)) ** 2
        # The brightness of each is w over the probability that it is active, so that its mean is w.
        bright = np.maximum(w, 1.0 / (self.density * solid))
        result: Floats = lit * swell * shape * bright * solid / mean
        return result

    def broken(self, air: Air, d: Floats, smooth: Floats) -> Floats:
        """The reflection (r, 3) toward −d (r, 3) whose mean over all hashes is ``smooth`` (r, 3)."""
        total = max(float(air.sun_irradiance.sum()), LIGHT_LEAST)
        w: Floats = np.maximum(smooth.sum(axis=1) / total, LIGHT_LEAST)
        here = self.side**2 * np.abs(d).sum(axis=1) ** 3
        apart = self.sparkles.share * (1.0 - smoothstep(0.5, 2.0, self.density * w * here))
        return smooth * (1.0 - apart + apart / w * self.light(d, w))[:, None]


def sun(light: Light, air: Air, time: float, step: float) -> Glint:
    """The sun on the water of a light at a time (s); ``step`` as for :class:`SparkleField`."""
    smooth: Glint = partial(glint, air)
    if light.specular != "glint":
        smooth = partial(blinn_phong, air, light.specular_power, light.specular_perturb)
    if light.sparkles is None:
        return smooth
    field = SparkleField(light.sparkles, time, step)

    def sparkling(d: Floats, n: Floats, cv: Floats, sigma2: float) -> Floats:
        return field.broken(air, d, smooth(d, n, cv, sigma2))

    return sparkling
