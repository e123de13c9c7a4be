"""Hard cases of foam.surf, and scenes that name it but in which it is invisible."""

from support.cases import Cases, HardCase
from support.hard.mutations import guards
from support.scenes import Camera, Foam, Light, Scene, Shore, Surf, SurfSaturation

_BEACH = Shore(size=160.0, depth=6.0, slope=0.1, smoothing=3.0)

_FOAM = Foam(saturation=(SurfSaturation(),), mask="clump")

_LIGHT = Light(sun_elevation=0.7, sun_azimuth=2.0, exposure=-2.0)

_VIEW = Camera(position=(-42.0, 7.0, 9.0), yaw=1.4, pitch=-0.2)

_INVISIBLE = (Scene(foam=_FOAM), Scene(shore=_BEACH.model_copy(update={"surf": Surf(height=0.0)}), foam=_FOAM))

_HARD = (
    HardCase(
        "surf foam on water as level as its ground",
        Scene(light=_LIGHT, shore=_BEACH.model_copy(update={"slope": 0.01, "surf": Surf(height=0.05)}), foam=_FOAM),
        guard="change of depth over a footprint at least 1 mm (foam/saturation/surf.glsl@front_filtered)",
        times=(0.0, 2.3),
        camera=_VIEW,
        without={"foam/saturation/surf.glsl": {", 1e-3, 0.15)": ", 0.0, 0.15)"}},
        missed_by=guards("foam", "functions_are_guarded[surf on level ground under level water]"),
    ),
    HardCase(
        "foam where no way leads to the shore",
        Scene(
            light=_LIGHT,
            shore=_BEACH.model_copy(update={"kind": "islands", "radius": 12.0, "smoothing": 0.0}),
            foam=_FOAM,
        ),
        guard="the gradient toward the shore divided by a length of at least 1e-6 (foam/saturation/surf.glsl@surf)",
        camera=_VIEW,
        without={"shore/waves.glsl": {"max(length(out_to_sea), 1e-6)": "length(out_to_sea)"}},
        missed_by=guards("foam", "functions_are_guarded[surf that no way leads from]"),
    ),
)

CASES = {"surf foam": Cases(invisible=_INVISIBLE, hard=_HARD)}
