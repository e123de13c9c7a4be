"""Test scenes of shores and shadows of land: hard cases, and scenes that name them but in which they are invisible."""

from support.cases import Cases, HardCase, reduced
from support.scenes import Camera, Foam, Light, Scene, Shore, Surf, SurfSaturation, Water

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
        "all water, a bank two metres down",
        _scene_shore(kind="island", height=0.0, level=-2.0),
        guard="distance to the coast at most the side of the square (shore/maps.glsl@distance)",
        camera=_VIEW_SHORE,
        without={"shore/maps.glsl": {"other.x < 0.0 ? u_viewport.x : length(other - at) -": "length(other - at) -"}},
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
)

CASES = {
    "shore": Cases(invisible=_INVISIBLE_SHORE, hard=_HARD_SHORE, variants=(_SMOOTH,)),
    "shadows of land": Cases(invisible=_INVISIBLE_SHADOW, hard=_HARD_SHADOW),
}
