"""The HTTP API: presets, plans, masks, textures and frames, with every error as problem+json."""
