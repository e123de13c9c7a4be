"""The body of the water: absorption, floor, caustics, and the view from below the surface.

What moves the surface is in :mod:`seafoam.effects.waves`, land in :mod:`seafoam.effects.shore`.
"""
