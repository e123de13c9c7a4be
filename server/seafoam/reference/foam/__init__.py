"""Sections 4, 5 and 14: saturations, looks, foam that lives or drifts."""
