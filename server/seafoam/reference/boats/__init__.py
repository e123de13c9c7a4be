"""Section 15 of docs/formulae.md in float64: boats and wakes."""
