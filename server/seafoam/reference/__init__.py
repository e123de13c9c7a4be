"""The float64 oracle: a second, independent writing of docs/formulae.md that frames of the GPU are judged by.

It shares the description of a scene, the masks and the foam texture with the renderer, and no line of its formulas.
Drops of spray alone are given to it, as they were at birth; their strands repeat the shader's.
Arrays are float64 unless said otherwise. Lengths are in metres, angles in radians, times in seconds.
"""

from seafoam.reference.foam.coverage import Assets
from seafoam.reference.renderer.frame import ReferenceFrame, render, scene_sha256
from seafoam.reference.renderer.state import Mode
from seafoam.reference.spray import Sprayed

__all__ = ["Assets", "Mode", "ReferenceFrame", "Sprayed", "render", "scene_sha256"]
