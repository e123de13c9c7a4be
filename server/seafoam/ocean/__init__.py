"""The physical model that effects and the float64 reference share: dispersion, spectra, ripples, rings, wakes, drift.

It contains no drawing code and no GLSL, and imports only scenes.
"""
