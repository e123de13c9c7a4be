"""Section 8: shores."""
