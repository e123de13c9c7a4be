"""Foam: saturations, looks, what carries it, its relief, and bubbles under it.

Waves that make foam are in :mod:`seafoam.effects.waves`.
"""
