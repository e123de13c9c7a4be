"""Sections 4, 5 and 14 of docs/formulae.md in float64: saturations, looks, and foam that moves.

Nothing here comes from an effect or from GLSL; rays and pixels are in :mod:`seafoam.reference.renderer`.
"""
