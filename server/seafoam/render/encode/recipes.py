"""What the formats share about the recipe that a picture carries."""

KEYWORD = "seafoam"
"""Name of the recipe: keyword of PNG's chunk, attribute of OpenEXR's header, prefix of its property in XMP."""


class NoRecipeError(ValueError):
    """A file is no picture with a recipe; the text says what it is instead."""
