"""Boats and their wakes.

Foam of wakes is in :mod:`seafoam.effects.foam`.
"""
