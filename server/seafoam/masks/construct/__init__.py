"""Constructions of masks, a module a family."""
