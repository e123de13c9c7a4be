"""Drops in the air, as points that are laid over the picture."""
