"""Rays through pixels, where they meet the surface, and the frame."""
