"""The scene: schema, units, ranges and presets. What follows from a scene is in :mod:`seafoam.ocean`."""
