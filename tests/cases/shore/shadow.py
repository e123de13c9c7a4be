"""Hard cases of shore.shadow, and scenes that name it but in which it is invisible."""

from support.cases import Cases, HardCase
from support.scenes import Camera, Foam, Light, Scene, Shore, SurfSaturation, Water

_ISLAND = Shore(
    kind="island", size=160.0, radius=25.0, depth=6.0, height=14.0, slope=0.3, smoothing=3.0, shadows=True, relief=0.5
)
_FOAM = Foam(saturation=(SurfSaturation(),), mask="clump")
_VIEW = Camera(position=(-42.0, 7.0, 9.0), yaw=-0.1, pitch=-0.1)


def _case(name: str, guard: str, elevation: float, azimuth: float = 0.6, camera: Camera = _VIEW) -> HardCase:
    light = Light(sun_elevation=elevation, sun_azimuth=azimuth, exposure=-2.0)
    scene = Scene(shore=_ISLAND, water=Water(scattering=0.01), foam=_FOAM, light=light)
    return HardCase(name, scene, guard=guard, camera=camera, times=(0.0,))


_INVISIBLE = (
    Scene(shore=_ISLAND, light=Light(sun_elevation=-0.3)),
    Scene(shore=_ISLAND.model_copy(update={"level": -900.0}), light=Light(sun_elevation=0.3)),
)

_HARD = (
    _case(
        "shadow of an island under a sun that touches the horizon",
        "sights of the sun's rims rise by at least a thousandth (effects/shore/shadow.py)",
        0.004,
    ),
    _case(
        "shadow of an island under a sun in the zenith",
        "level part of the sun's direction at least 1e-6, its rims at most 1.5 rad high (effects/shore/shadow.py)",
        1.5707963,
    ),
    _case(
        "shadow of an island across the edge of its square",
        "beyond the square by the place where the way to the sun enters it (shore/sunlit.glsl@sunlit)",
        0.05,
        camera=Camera(position=(-120.0, 9.0, -40.0), yaw=0.3, pitch=-0.1),
    ),
    _case(
        "shadow along an axis of the square",
        "level part of the sun's direction along an axis at least 1e-6 (shore/sunlit.glsl@sunlit)",
        0.1,
        azimuth=0.0,
        camera=Camera(position=(-120.0, 9.0, -40.0), yaw=0.3, pitch=-0.1),
    ),
)

CASES = {"shadows of land": Cases(invisible=_INVISIBLE, hard=_HARD)}
