"""Sections 6, 9 and 12 of docs/formulae.md in float64: light and sky."""
