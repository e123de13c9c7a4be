"""Hard cases of light.glare."""

import math

from support.cases import Cases, HardCase
from support.scenes import Camera, Light, Scene, Sky

_HARD = (
    HardCase(
        "glare of the brightest sun",
        Scene(light=Light(sun_elevation=0.3, exposure=10.0, glare=0.5, sky=Sky())),
        guard="what spreads is at most 4096 a pixel (output/glare.glsl@first)",
        camera=Camera(position=(0.0, 3.0, 0.0), yaw=math.pi / 2, pitch=0.2, fov=0.3),
        unseen="not needed: levels are means of a frame that holds at most 65504",
    ),
)

CASES = {
    "glare": Cases(
        hard=_HARD,
        always_visible="any share that is not 0 spreads some light",
        variants=(Scene(light=Light(glare=0.1)), Scene(light=Light(tone="photographic"))),
    )
}
