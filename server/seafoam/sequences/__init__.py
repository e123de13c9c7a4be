"""Frames by the thousand: directories of frames, animated WebP and MP4, resumed where they stopped.

Frames are drawn by :class:`seafoam.sequences.spec.Workers`; every finished one is on disk with its hash.
"""
