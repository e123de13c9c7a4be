"""Effects of the water's body: absorption, floor, caustics, and the view from below the surface."""
