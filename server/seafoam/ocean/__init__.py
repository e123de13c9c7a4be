"""The physical model that effects and the float64 reference share. It imports only scenes, and has no GLSL."""
