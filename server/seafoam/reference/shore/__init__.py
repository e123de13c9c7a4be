"""Section 8 of docs/formulae.md in float64: shores."""
