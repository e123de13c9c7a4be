"""Textures that plans refer to: typed descriptions, and the same bytes for every executor.

Nothing here depends on time or camera, and no effect is known by name.
"""
