"""Drops in the air, drawn as points over the picture."""
