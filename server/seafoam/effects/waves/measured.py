"""Bounds of waves in a map, measured in each frame: passes that find its greatest height, slope and curvature.

docs/formulae.md, section 3.
"""

from seafoam.effects.effect import PassSpec, Resources, drawn_map
from seafoam.effects.shader import Inline
from seafoam.framegraph.resources import FixedSize, Target
from seafoam.framegraph.rules import number

BLOCK = 16
"""Side of the blocks whose maxima are found first, texels."""


def measured_bounds(source: str, size: int, texel: float, stride: int = 1) -> Resources:
    """Targets and passes of a map's bounds. ``SOURCE_bounds`` holds height (m), slope and second derivative (1/m).

    ``source``: a target of ``size``² texels of ``texel`` m that holds height and the slopes along x and z; ``size`` is
    a multiple of :data:`BLOCK`. ``stride``: only every so many texels along each side are read; the shortest wave must
    be at least four times as long.
    """
    blocks, bounds = f"{source}_blocks", f"{source}_bounds"
    sizes = Inline(f"const int BOUNDS_BLOCK = {BLOCK};\nconst int BOUNDS_STRIDE = {stride};\n")
    files, texels = (sizes, "surface/bounds.glsl@pass"), {"u_bounded_texel": number(texel)}
    name = f"{source}, greatest of blocks"
    of_blocks = PassSpec(name, f"bounds_{stride}", files, {"u_bounded": source}, texels, target=blocks)
    join = ("surface/bounds.glsl@join",)
    of_all = PassSpec(f"{source}, greatest of all", "bounds_join", join, {"u_blocks": blocks}, target=bounds)
    return drawn_map(of_blocks, Target(size=FixedSize.square(-(-size // BLOCK)), format="RGBA16F")).joined(
        drawn_map(of_all, Target(size=FixedSize.square(1), format="RGBA16F"))
    )
