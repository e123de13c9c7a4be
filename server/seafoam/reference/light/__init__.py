"""Sections 6, 9 and 12 of docs/formulae.md in float64: light and sky.

Nothing here comes from an effect or from GLSL; rays and pixels are in :mod:`seafoam.reference.renderer`.
"""
