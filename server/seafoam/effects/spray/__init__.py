"""Effects of drops in the air."""
