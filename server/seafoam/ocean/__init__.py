"""The physical model that effects and the float64 reference share: dispersion, spectra, ripples, rings, wakes, drift.

No drawing and no GLSL; it imports scenes alone.
"""
