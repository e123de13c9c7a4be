"""Section 11 of docs/formulae.md in float64: the seafloor, caustics and the view from below.

Nothing here comes from an effect or from GLSL; rays and pixels are in :mod:`seafoam.reference.renderer`.
"""
