"""Effects of what the water mirrors."""
