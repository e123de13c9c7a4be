"""Section 13: spray."""
