"""Effects of light and sky."""
