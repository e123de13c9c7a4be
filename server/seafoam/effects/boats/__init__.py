"""Effects of boats and their wakes."""
