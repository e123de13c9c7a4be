"""Sections 6, 9 and 12: light and sky."""
