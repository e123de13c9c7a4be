"""Statistics of measured frame times, and the linear model of time over the number of pixels."""

from statistics import median, quantiles

from seafoam.accuracy.model import TimeModel, TimeSpread


def spread_of(values: list[float]) -> TimeSpread:
    """Median and quartiles of the times of all rounds, ms."""
    low, middle, high = quantiles(values, n=4, method="inclusive")
    return TimeSpread(median_ms=middle, low_ms=low, high_ms=high, rounds_ms=tuple(round(value, 4) for value in values))


def time_model(large_ms: float, large: tuple[int, int], small_ms: float, small: tuple[int, int]) -> TimeModel:
    """The linear model through the times of two frame sizes (pixels): a constant, at least 0, and a time per pixel."""
    pixels, few = large[0] * large[1], small[0] * small[1]
    if pixels == few:
        return TimeModel(fixed_ms=0.0, ns_per_pixel=1e6 * large_ms / pixels)
    slope = max(0.0, (large_ms - small_ms) / (pixels - few))
    return TimeModel(fixed_ms=max(0.0, large_ms - slope * pixels), ns_per_pixel=1e6 * slope)


def median_model(models: list[TimeModel], size: tuple[int, int]) -> TimeModel:
    """The median constant, with a time per pixel that gives the median time at ``size``."""
    fixed = median(model.fixed_ms for model in models)
    left = max(0.0, median(model.at(*size) for model in models) - fixed)
    return TimeModel(fixed_ms=fixed, ns_per_pixel=1e6 * left / (size[0] * size[1]))
