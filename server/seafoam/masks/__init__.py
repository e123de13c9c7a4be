"""Halftone masks: how they are made and judged, tables that filter them, files, and the shipped catalogue."""
