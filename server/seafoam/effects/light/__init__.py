"""Sun, sky, clouds, moon and stars, and what glitters.

What the water mirrors is in :mod:`seafoam.effects.reflection`.
"""
