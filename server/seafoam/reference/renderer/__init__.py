"""The float64 renderer: rays through pixels, where they meet the surface, and the frame."""
