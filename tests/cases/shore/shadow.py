"""Hard cases of shore.shadow, and scenes that name it but in which it is invisible."""

from support.cases import Cases, HardCase
from support.hard.mutations import guards
from support.scenes import Camera, Foam, Light, Scene, Shore, SurfSaturation, Water

_ISLAND = Shore(
    kind="island", size=160.0, radius=25.0, depth=6.0, height=14.0, slope=0.3, smoothing=3.0, shadows=True, relief=0.5
)
_FOAM = Foam(saturation=(SurfSaturation(),), mask="clump")
_VIEW = Camera(position=(-42.0, 7.0, 9.0), yaw=-0.1, pitch=-0.1)


def _scene(elevation: float, azimuth: float = 0.6) -> Scene:
    light = Light(sun_elevation=elevation, sun_azimuth=azimuth, exposure=-2.0)
    return Scene(shore=_ISLAND, water=Water(scattering=0.01), foam=_FOAM, light=light)


_INVISIBLE = (
    Scene(shore=_ISLAND, light=Light(sun_elevation=-0.3)),
    Scene(shore=_ISLAND.model_copy(update={"level": -900.0}), light=Light(sun_elevation=0.3)),
)

_HARD = (
    HardCase(
        "shadow of an island under a sun that touches the horizon",
        _scene(0.004),
        guard="sights of the sun's rims rise by at least a thousandth (effects/shore/land.py)",
        camera=_VIEW,
        without={"effects/shore/land.py": {"max(math.tan(lower), LOWEST_RISE)": "math.tan(lower)"}},
        missed_by=guards("ground", "shadows_of_land_end[0.004-20000.0]"),
    ),
    HardCase(
        "shadow of an island under a sun in the zenith",
        _scene(1.5707963),
        guard="level part of the sun's direction at least 1e-6, its rims at most 1.5 rad high (effects/shore/land.py)",
        camera=_VIEW,
        without={
            "effects/shore/land.py": {
                "max(math.hypot(x, z), 1e-6)": "math.hypot(x, z)",
                "min(elevation + SUN_RADIUS, 1.5)": "elevation + SUN_RADIUS",
                "min(elevation - SUN_RADIUS, 1.49)": "elevation - SUN_RADIUS",
            }
        },
    ),
    HardCase(
        "shadow of an island across the edge of its square",
        _scene(0.05),
        guard="beyond the square by the place where the way to the sun enters it (shore/sunlit.glsl@sunlit)",
        camera=Camera(position=(-120.0, 9.0, -40.0), yaw=0.3, pitch=-0.1),
        without={"shore/sunlit.glsl": {"float way = max(enters.x, enters.y)": "float way = 0.0"}},
        missed_by=guards("ground", "shadows_of_land_end[0.05-2000.0]"),
    ),
    HardCase(
        "shadow along an axis of the square",
        _scene(0.1, 0.0),
        guard="level part of the sun's direction along an axis at least 1e-6 (shore/sunlit.glsl@sunlit)",
        camera=Camera(position=(-120.0, 9.0, -40.0), yaw=0.3, pitch=-0.1),
        without={"shore/sunlit.glsl": {"max(abs(u_land_sun.xy), 1e-6)": "abs(u_land_sun.xy)"}},
        missed_by=guards("ground", "functions_are_guarded[sun along an axis, beside the square]"),
    ),
)

CASES = {"shadows of land": Cases(invisible=_INVISIBLE, hard=_HARD)}
