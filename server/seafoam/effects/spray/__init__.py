"""Drops in the air, drawn as points over the picture.

The waves and rocks that throw them are in other packages.
"""
