"""Halftone masks: construction, spectra, filtering tables, files and the shipped catalogue.

The plots are in :mod:`seafoam.masks.judge.plots`, which alone needs matplotlib, and the baking in
:mod:`seafoam.masks.bake`.
"""

from seafoam.masks.catalogue import (
    Mask,
    MaskEntry,
    MaskTables,
    MaskTooSlowError,
    UnknownMaskError,
    custom_mask,
    load_catalogue,
    load_mask,
    mask_by_name,
    rank_sha256,
)
from seafoam.masks.construct.make import estimated_seconds, make_mask
from seafoam.masks.families import (
    FAMILIES,
    METHODS,
    SIZES,
    Family,
    Method,
    check_parameters,
    parse_parameters,
    sigma_range,
)
from seafoam.masks.formats import to_dds, to_npy, to_png8, to_png16, to_u16
from seafoam.masks.judge.morphology import FoamShapes, MaskMorphology, measure_morphology
from seafoam.masks.judge.spectrum import GREY_LEVELS, GreySpectrum, MaskSpectrum, measure_spectrum
from seafoam.masks.prefilter import (
    bspline_weights,
    footprint_deviations,
    quantile_lookup,
    quantile_position,
    quantile_table,
)

__all__ = [
    "FAMILIES",
    "GREY_LEVELS",
    "METHODS",
    "SIZES",
    "Family",
    "FoamShapes",
    "GreySpectrum",
    "Mask",
    "MaskEntry",
    "MaskMorphology",
    "MaskSpectrum",
    "MaskTables",
    "MaskTooSlowError",
    "Method",
    "UnknownMaskError",
    "bspline_weights",
    "check_parameters",
    "custom_mask",
    "estimated_seconds",
    "footprint_deviations",
    "load_catalogue",
    "load_mask",
    "make_mask",
    "mask_by_name",
    "measure_morphology",
    "measure_spectrum",
    "parse_parameters",
    "quantile_lookup",
    "quantile_position",
    "quantile_table",
    "rank_sha256",
    "sigma_range",
    "to_dds",
    "to_npy",
    "to_png8",
    "to_png16",
    "to_u16",
]
