"""Section 11 of docs/formulae.md in float64: the seafloor, caustics and the view from below."""
