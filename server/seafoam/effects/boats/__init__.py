"""Boats and their wakes."""
