"""Physical constants."""

GRAVITY = 9.81
"""Gravitational acceleration, m/s²."""
WATER_INDEX = 1.34
"""Refractive index of water against air, visible light; ``lib/refraction.glsl`` has the same."""
