"""Section 13 of docs/formulae.md in float64: spray.

Nothing here comes from an effect or from GLSL; rays and pixels are in :mod:`seafoam.reference.renderer`.
"""
