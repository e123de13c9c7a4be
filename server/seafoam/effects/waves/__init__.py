"""Effects that move the surface."""
