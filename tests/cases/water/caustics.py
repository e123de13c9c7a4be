"""Hard cases of water.caustics, and scenes that call for it and cannot show it."""

from itertools import product

from support.cases import Bounds, Cases, HardCase
from support.hard.mutations import IN_FLOAT32, guards, reference
from support.scenes import Camera, Caustics, Light, Ripples, Scene, Water

_PLAIN = Caustics(dispersion=0.0)

_LIGHT = Light(sun_elevation=1.0, exposure=-2.5, caustics=_PLAIN)

_DEEP = Water(depth=900.0, ripples=Ripples())

_DOWN = Camera(position=(0.0, 2.0, 0.0), pitch=-1.2)


_INVISIBLE = (
    Scene(water=_DEEP, light=Light(caustics=Caustics())),
    Scene(water=Water(depth=2.0, ripples=Ripples()), light=Light(sun_elevation=-0.3, caustics=Caustics())),
)

_HARD = (
    HardCase(
        "the floor in the focus",
        Scene(water=Water(depth=4.0, scattering=0.0, ripples=Ripples(slope=0.08)), light=_LIGHT),
        guard="a triangle is at most 12 times as bright as under level water (water/caustics.glsl@grid_vertex)",
        times=(2.0,),
        camera=_DOWN,
        # Half floats add up a hundred photons a texel, each sum rounded.
        bounds=Bounds(mean=0.5, share=0.03),
        # SwiftShader's sine, good to 2e-4, moves lines of light in a focus, a pixel wide.
        coarse_share=0.15,
        without={
            "water/caustics.glsl": {"max(abs(a.x * b.y - a.y * b.x), 1.0 / CAUSTIC_MOST)": "abs(a.x * b.y - a.y * b.x)"}
        },
        missed_by=guards("ground", "a_grid_is_no_brighter_in_a_focus_than_photons"),
    ),
    HardCase(
        "caustics of a sun on the horizon",
        Scene(water=Water(depth=1.0, ripples=Ripples(slope=0.1)), light=Light(sun_elevation=0.0, caustics=_PLAIN)),
        guard="the sine of the sun's elevation is at least 0.05 (water/caustics.glsl@landing)",
        times=(2.0,),
        camera=_DOWN,
        without={"water/caustics.glsl": {"max(u_sun_direction.y, 0.05)": "u_sun_direction.y"}},
    ),
    HardCase(
        "caustics of the steepest ripples",
        Scene(
            water=Water(depth=3.0, ripples=Ripples(slope=0.6)),
            light=Light(sun_elevation=0.1, exposure=-1.0, caustics=_PLAIN),
        ),
        guard="the cosine between a refracted ray and the vertical is at least 0.25 (water/caustics.glsl@landing)",
        times=(2.0,),
        camera=_DOWN,
        without={"water/caustics.glsl": {"max(-ray.y, 0.25)": "-ray.y"}},
    ),
    HardCase(
        "caustics after thirty years, ten thousand kilometres away",
        Scene(water=Water(depth=2.0, floor_tile=0.3, ripples=Ripples(slope=0.06)), light=_LIGHT),
        guard="phases and the camera's position in the tile are reduced in float64 (framegraph/evaluation.py)",
        times=(1e9,),
        camera=Camera(position=(-1e7, 2.0, 1e7), pitch=-1.2),
        without=IN_FLOAT32,
    ),
    HardCase(
        "colours as far apart as they go",
        Scene(
            water=Water(depth=6.0, absorption_length=(50.0, 50.0, 50.0), ripples=Ripples(slope=0.06)),
            light=Light(sun_elevation=0.3, exposure=-1.0, caustics=Caustics(dispersion=10.0)),
        ),
        guard="the grid extends beyond the tile as far as light of any colour is displaced (effects/water/caustics.py)",
        times=(2.0,),
        camera=_DOWN,
        # SwiftShader's sine, good to 2e-4, moves lines of light in a focus, a pixel wide.
        coarse_share=0.2,
        without={"effects/water/caustics.py": {"margin, size = tile.margin(cells)": "margin, size = 0"}},
        missed_by=reference("light/caustics", "no_seam_shows[caustics_cells-grid]"),
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
