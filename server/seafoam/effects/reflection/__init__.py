"""Reflections in the water other than the plain sky: cube maps, boats and land."""
