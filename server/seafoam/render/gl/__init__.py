"""Plans drawn with OpenGL."""
