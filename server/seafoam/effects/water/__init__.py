"""Effects of the water's body and of what lies under it."""
