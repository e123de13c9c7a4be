"""Section 2 of docs/formulae.md in float64: what moves the surface.

Nothing here comes from an effect or from GLSL; rays and pixels are in :mod:`seafoam.reference.renderer`.
"""
