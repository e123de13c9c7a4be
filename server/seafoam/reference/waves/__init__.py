"""Section 2: what moves the surface."""
