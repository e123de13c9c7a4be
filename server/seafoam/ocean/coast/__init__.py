"""The sea floor, the travel of swell over it, and rocks."""
