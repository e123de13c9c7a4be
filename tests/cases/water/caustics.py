"""Hard cases of water.caustics, and scenes that call for it and cannot show it."""

from dataclasses import replace
from itertools import product

from support.cases import Bounds, Cases, HardCase
from support.scenes import Camera, Caustics, Light, Ripples, Scene, Water

_PLAIN = Caustics(dispersion=0.0)

_DEEP = Water(depth=900.0, ripples=Ripples())

_DOWN = Camera(position=(0.0, 2.0, 0.0), pitch=-1.2)


def _case(
    name: str,
    guard: str,
    water: Water,
    light: Light | None = None,
    camera: Camera = _DOWN,
    times: tuple[float, ...] = (2.0,),
) -> HardCase:
    scene = Scene(water=water, light=light or Light(sun_elevation=1.0, exposure=-2.5, caustics=_PLAIN))
    return HardCase(name, scene, guard=guard, camera=camera, times=times)


_INVISIBLE = (
    Scene(water=_DEEP, light=Light(caustics=Caustics())),
    Scene(water=Water(depth=2.0, ripples=Ripples()), light=Light(sun_elevation=-0.3, caustics=Caustics())),
)

_HARD = (
    replace(
        _case(
            "the floor in the focus",
            "a triangle is at most 12 times as bright as under level water (water/caustics.glsl@grid_vertex)",
            Water(depth=4.0, scattering=0.0, ripples=Ripples(slope=0.08)),
        ),
        # Half floats add up a hundred photons a texel, each sum rounded.
        bounds=Bounds(mean=0.5, share=0.03),
        # SwiftShader's sine, good to 2e-4, moves lines of light in a focus, a pixel wide.
        coarse_share=0.15,
    ),
    _case(
        "caustics of a sun on the horizon",
        "the sine of the sun's elevation is at least 0.05 (water/caustics.glsl@landing)",
        Water(depth=1.0, ripples=Ripples(slope=0.1)),
        Light(sun_elevation=0.0, caustics=_PLAIN),
    ),
    _case(
        "caustics of the steepest ripples",
        "the cosine between a refracted ray and the vertical is at least 0.25 (water/caustics.glsl@landing)",
        Water(depth=3.0, ripples=Ripples(slope=0.6)),
        Light(sun_elevation=0.1, exposure=-1.0, caustics=_PLAIN),
    ),
    _case(
        "caustics after thirty years, ten thousand kilometres away",
        "phases and the camera's position in the tile are reduced in float64 (framegraph/evaluation.py)",
        Water(depth=2.0, floor_tile=0.3, ripples=Ripples(slope=0.06)),
        camera=Camera(position=(-1e7, 2.0, 1e7), pitch=-1.2),
        times=(1e9,),
    ),
    replace(
        _case(
            "colours as far apart as they go",
            "the grid extends beyond the tile as far as light of any colour is displaced (effects/water/caustics.py)",
            Water(depth=6.0, absorption_length=(50.0, 50.0, 50.0), ripples=Ripples(slope=0.06)),
            Light(sun_elevation=0.3, exposure=-1.0, caustics=Caustics(dispersion=10.0)),
        ),
        # SwiftShader's sine, good to 2e-4, moves lines of light in a focus, a pixel wide.
        coarse_share=0.2,
    ),
)

_VARIANTS = tuple(
    Scene(
        water=Water(depth=2.0, floor_tile=tile, view_below=below, ripples=Ripples()),
        light=Light(caustics=Caustics(dispersion=dispersion)),
    )
    for dispersion, tile, below in product((0.0, 1.0), (None, 0.3), (False, True))
)

CASES = {"caustics": Cases(invisible=_INVISIBLE, hard=_HARD, variants=_VARIANTS)}
