"""Effects of foam: saturations, looks, its life and what it lies on."""
