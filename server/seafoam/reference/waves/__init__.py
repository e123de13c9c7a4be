"""Section 2 of docs/formulae.md in float64: what moves the surface."""
