"""Section 15: boats."""
