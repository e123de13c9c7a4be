"""Effects of land and shallows."""
