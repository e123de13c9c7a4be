"""Test scenes of shores and shadows of land: hard cases, and scenes that name them but in which they are invisible."""

from support.cases import Cases, HardCase, reduced
from support.hard.mutations import guards, reference
from support.scenes import Camera, Foam, Light, Ripples, Scene, Shore, Surf, SurfSaturation, Water

_FOAM = Foam(saturation=(SurfSaturation(),), mask="clump")

_LIGHT = Light(sun_elevation=0.7, sun_azimuth=2.0, exposure=-2.0)

_VIEW_SHORE = Camera(position=(-42.0, 7.0, 9.0), yaw=1.4, pitch=-0.2)

_CLEAR = Water(scattering=0.01)

_SMALL = Shore(size=160.0, radius=25.0, depth=6.0, slope=0.1, smoothing=3.0)


def _scene_shore(water: Water = _CLEAR, **fields: object) -> Scene:
    return Scene(shore=_SMALL.model_copy(update=fields), water=water, foam=_FOAM, light=_LIGHT)


_INVISIBLE_SHORE = (Scene(shore=Shore(depth=50.0, level=-900.0)), Scene(shore=Shore(level=-900.0), light=None))

_HARD_SHORE = (
    HardCase(
        "distances without any smoothing",
        _scene_shore(smoothing=0.0),
        guard="standard deviation of the blur at least 0.01 texel (shore/maps.glsl@blur)",
        camera=_VIEW_SHORE,
        unseen="Mesa takes a constant 0 over anything for 0, which the guard gives",
    ),
    HardCase(
        "all water, a bank two metres down",
        _scene_shore(kind="island", height=0.0, level=-2.0),
        guard="distance to the coast at most the side of the square (shore/maps.glsl@distance)",
        camera=_VIEW_SHORE,
        without={"shore/maps.glsl": {"other.x < 0.0 ? u_viewport.x : length(other - at) -": "length(other - at) -"}},
    ),
    HardCase(
        "an island of one texel",
        _scene_shore(kind="island", radius=1.0, smoothing=0.5, height=0.5, slope=0.4),
        guard="wave height 0 on ridges of the distance map (shore/maps.glsl@map)",
        camera=_VIEW_SHORE,
        without={"shore/maps.glsl": {"smooth_between(0.3, 0.8, steep)": "1.0"}},
        missed_by=reference("shore/shore", "the_map_is_the_references[0.0-False-islands]"),
    ),
    HardCase(
        "water a hand deep and a beach as level",
        _scene_shore(depth=0.5, slope=0.01, height=0.1, surf=Surf(height=0.0)),
        guard="depths and speeds as for waves of at least 5 cm (shore/maps.glsl@map)",
        camera=_VIEW_SHORE,
        without={
            "shore/maps.glsl": {
                "max(0.3 * u_surf_height, 0.05)": "0.3 * u_surf_height",
                "max(u_surf_height, 0.05)": "u_surf_height",
            }
        },
        missed_by=guards("ground", "a_shore_without_surf_has_a_finite_map"),
    ),
    HardCase(
        "waves of no skew and of all of it",
        _scene_shore(surf=Surf(height=2.0, skew=0.0, sharpness=0.15)),
        guard="profiles from a table, smoothed, with the highest branch where they overhang (textures/shore.py)",
        times=(0.0, 2.3),
        camera=Camera(position=(-42.0, 9.0, 9.0), yaw=1.4, pitch=-0.25),
        without={"textures/shore.py": {"np.fft.irfft(np.fft.rfft(top) * spread, fine)": "top"}},
        missed_by=guards("ground", "fronts_are_no_steeper_than_a_smoothed_step"),
    ),
    HardCase(
        "ripples that face away",
        _scene_shore(water=Water(ripples=Ripples(slope=0.6), scattering=0.01)),
        guard="the refracted ray's direction has y of at most -0.25 (shore/floor.glsl@through)",
        camera=Camera(position=(-42.0, 2.2, 9.0), yaw=1.4, pitch=-0.05),
        without={"shore/floor.glsl": {"max(-r.y, 0.25)": "-r.y"}},
        missed_by=guards("ground", "functions_are_guarded[way through ripples that face the eye]"),
    ),
    reduced(
        "a shore ten thousand kilometres away, after thirty years",
        _scene_shore(place=(-9999900.0, 9999900.0)),
        "position and time",
        Camera(position=(-9999942.0, 7.0, 9999909.0), yaw=1.4, pitch=-0.2),
    ),
    HardCase(
        "a swell that the depth bends, over a beach all but level",
        _scene_shore(kind="island", slope=0.02, surf=Surf(height=0.1, period=2.0, exposure=1.0, refraction=True)),
        guard="speeds as over at least 5 cm of water, on land as well (ocean/coast/travel.py)",
        times=(0.0, 1e9),
        camera=_VIEW_SHORE,
        without={"ocean/coast/travel.py": {"np.maximum(depth, least)": "np.maximum(depth, 0.0)"}},
    ),
    HardCase(
        "rugged land of full detail, seen along the ground",
        _scene_shore(relief=1.0, height=60.0, slope=1.0, plants_from=0.0),
        guard="footprints of no width are taken as 1e-9 m wide; octaves under them as whole (shore/soil.glsl@soil)",
        camera=Camera(position=(-42.0, 2.0, 9.0), yaw=1.4, pitch=0.1),
        unseen="llvmpipe's max(NaN, x) is x, which is what the guard gives",
    ),
    HardCase(
        "eye inside a hill",
        _scene_shore(),
        guard="the distance to land is at least 0 (shore/march.glsl@march)",
        camera=Camera(position=(40.0, 0.5, 0.0), yaw=1.4, pitch=0.1),
        apart="the reference looks for the hill from its inside, the march takes the eye's own place",
        without={
            "shore/ground.glsl": {
                "max(max(min(one.x, two.x), min(one.y, two.y)), 0.0)": "max(min(one.x, two.x), min(one.y, two.y))"
            }
        },
        missed_by=guards("ground", "functions_are_guarded[span from inside]"),
    ),
)

_SMOOTH = Scene(shore=_SMALL.model_copy(update={"detail": 0.0}), foam=_FOAM, light=_LIGHT)

_ISLAND = Shore(
    kind="island", size=160.0, radius=25.0, depth=6.0, height=14.0, slope=0.3, smoothing=3.0, shadows=True, relief=0.5
)
_VIEW_SHADOW = Camera(position=(-42.0, 7.0, 9.0), yaw=-0.1, pitch=-0.1)


def _scene_shadow(elevation: float, azimuth: float = 0.6) -> Scene:
    light = Light(sun_elevation=elevation, sun_azimuth=azimuth, exposure=-2.0)
    return Scene(shore=_ISLAND, water=Water(scattering=0.01), foam=_FOAM, light=light)


_INVISIBLE_SHADOW = (
    Scene(shore=_ISLAND, light=Light(sun_elevation=-0.3)),
    Scene(shore=_ISLAND.model_copy(update={"level": -900.0}), light=Light(sun_elevation=0.3)),
)

_HARD_SHADOW = (
    HardCase(
        "shadow of an island under a sun that touches the horizon",
        _scene_shadow(0.004),
        guard="sights of the sun's rims rise by at least a thousandth (effects/shore/shore.py)",
        camera=_VIEW_SHADOW,
        without={"effects/shore/shore.py": {"max(math.tan(lower), LOWEST_RISE)": "math.tan(lower)"}},
        missed_by=guards("ground", "shadows_of_land_end[0.004-20000.0]"),
    ),
    HardCase(
        "shadow of an island under a sun in the zenith",
        _scene_shadow(1.5707963),
        guard="level part of the sun's direction at least 1e-6, its rims at most 1.5 rad high (effects/shore/shore.py)",
        camera=_VIEW_SHADOW,
        without={
            "effects/shore/shore.py": {
                "max(math.hypot(x, z), 1e-6)": "math.hypot(x, z)",
                "min(elevation + SUN_RADIUS, 1.5)": "elevation + SUN_RADIUS",
                "min(elevation - SUN_RADIUS, 1.49)": "elevation - SUN_RADIUS",
            }
        },
    ),
    HardCase(
        "shadow of an island across the edge of its square",
        _scene_shadow(0.05),
        guard="beyond the square by the place where the way to the sun enters it (shore/sunlit.glsl@sunlit)",
        camera=Camera(position=(-120.0, 9.0, -40.0), yaw=0.3, pitch=-0.1),
        without={"shore/sunlit.glsl": {"float way = max(enters.x, enters.y)": "float way = 0.0"}},
        missed_by=guards("ground", "shadows_of_land_end[0.05-2000.0]"),
    ),
)

CASES = {
    "shore": Cases(invisible=_INVISIBLE_SHORE, hard=_HARD_SHORE, variants=(_SMOOTH,)),
    "shadows of land": Cases(invisible=_INVISIBLE_SHADOW, hard=_HARD_SHADOW),
}
