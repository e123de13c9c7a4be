"""Sections 4, 5 and 14 of docs/formulae.md in float64: saturations, looks, and foam that moves."""
