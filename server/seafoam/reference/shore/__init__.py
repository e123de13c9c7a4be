"""Section 8 of docs/formulae.md in float64: shores.

Nothing here comes from an effect or from GLSL; rays and pixels are in :mod:`seafoam.reference.renderer`.
"""
