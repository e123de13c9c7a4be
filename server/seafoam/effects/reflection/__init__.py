"""Reflections in the water other than the plain sky: cube maps, boats and land.

The sky itself and the sun's glitter are in :mod:`seafoam.effects.light`.
"""
