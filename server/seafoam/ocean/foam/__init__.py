"""Whitecaps, and the spray of a sea."""
