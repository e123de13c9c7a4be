"""Effects of light: sun, sky, clouds, moon and stars, glitter.

Reflections in the water are in :mod:`seafoam.effects.reflection`.
"""
