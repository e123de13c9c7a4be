"""Worker processes that render for a server: queue, deadlines, errors.

No OpenGL in the calling process.
"""
