"""What raises or tilts the surface: parametric waves, seas, rings, ripples.

No foam and no light.
"""
