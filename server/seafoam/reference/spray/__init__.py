"""Section 13 of docs/formulae.md in float64: spray."""
