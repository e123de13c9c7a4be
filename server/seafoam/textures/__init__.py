"""Textures that plans refer to: typed descriptions, and the same bytes for every executor, time and camera."""
