"""The water's body, its floor, caustics on that, and the view from under the surface."""
