"""Land, shallows and the waves that reach them. Surf's foam is in :mod:`seafoam.effects.foam`."""
