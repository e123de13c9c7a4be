"""Rigs for tests: a renderer whose times and errors are known."""

import numpy as np

from seafoam.accuracy.sweep import Rig
from seafoam.render.service.jobs import Drawn

INFO = {"vendor": "Nobody", "renderer": "noise", "version": "0"}
FIXED_MS, NS = 2.0, 500.0


def noisy(log=None):
    """A grey picture with noise that falls with the samples, in 2 ms and 500 ns a pixel and sample."""

    def measure(job):
        if log is not None:
            log.append(job)
        drawn = []
        for draw in job.draws:
            seconds = 1e-3 * FIXED_MS + 1e-9 * NS * job.quality.samples * draw.width * draw.height
            pixels = None
            if draw.keep:
                noise = np.random.default_rng(7).normal(size=(draw.height, draw.width, 4))
                pixels = (0.5 + 0.1 / job.quality.samples * noise).astype(np.float32)
            drawn.append(Drawn(seconds, pixels))
        return tuple(drawn)

    return Rig(measure, INFO, 1)


def grey_truth(store, spec, measure, watcher):
    return np.full((spec.height, spec.width, 4), 0.5, np.float32)
