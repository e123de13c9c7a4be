"""Section 11: the seafloor, caustics and the view from below."""
