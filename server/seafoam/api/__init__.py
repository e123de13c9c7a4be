"""The HTTP API: presets, plans, masks, textures and frames, with every error as problem+json.

It contains no formula and no drawing, and the command line is the only package that may import it.
"""
