"""The body of the water: absorption, floor, caustics, and the view from below the surface."""
