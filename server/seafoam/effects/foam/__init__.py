"""Foam: saturations, looks, what carries it, its relief, and bubbles under it."""
