"""The scene: what the sea is. Schema, units, ranges and presets.

No physics, no drawing: what follows from a scene is in :mod:`seafoam.ocean`.
"""
