"""Frame plans drawn: the OpenGL executor, worker processes round it, and encoded pictures.

Nothing here knows an effect by name.
"""
