"""Land, shallows and the waves that reach them.

Foam of the surf is in :mod:`seafoam.effects.foam`.
"""
