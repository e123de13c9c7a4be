"""Hard cases of light.light, and scenes that call for it and cannot show it."""

import math

from support.cases import Cases, HardCase
from support.hard.mutations import BRIGHTEST, guards
from support.scenes import Camera, Foam, HeightSaturation, Light, Moon, ParametricWave, Ripples, Scene, Sky, Water

_HARD = (
    HardCase(
        "sun at the horizon",
        Scene(light=Light(sun_elevation=0.0, turbidity=10.0), water=Water(ripples=Ripples())),
        guard="offsets of 0.03 and 0.09 in the air masses (docs/formulae.md, section 6)",
        camera=Camera(position=(0.0, 3.0, 0.0), yaw=math.pi / 2, pitch=0.0),
        without={
            "light/sky.glsl": {"(max(d.y, 0.0) + 0.09)": "max(d.y, 0.0)"},
            "effects/light/atmosphere.py": {"(max(height, 0.0) + 0.03)": "max(height, 0.0)"},
        },
        error="ZeroDivisionError",
    ),
    HardCase(
        "sun under the horizon",
        Scene(light=Light(sun_elevation=-0.3, turbidity=10.0), water=Water(ripples=Ripples())),
        guard="offsets of 0.03 and 0.09 in the air masses (docs/formulae.md, section 6)",
        camera=Camera(position=(0.0, 3.0, 0.0), yaw=math.pi / 2, pitch=0.0),
        without={"effects/light/atmosphere.py": {"(max(height, 0.0) + 0.03)": "max(height, 0.0)"}},
        error="ZeroDivisionError",
    ),
    HardCase(
        "sun at the zenith",
        Scene(light=Light(sun_elevation=math.pi / 2, turbidity=10.0), water=Water(ripples=Ripples())),
        guard="offsets of 0.03 and 0.09 in the air masses (docs/formulae.md, section 6)",
        camera=Camera(position=(0.0, 3.0, 0.0), yaw=math.pi / 2, pitch=0.0),
        without={"light/sky.glsl": {"(max(d.y, 0.0) + 0.09)": "max(d.y, 0.0)"}},
    ),
    HardCase(
        "straight up and straight down, no heading",
        Scene(
            light=Light(sun_elevation=math.pi / 2),
            foam=Foam(saturation=(HeightSaturation(base=-1.0, full=1.0),), look="textured"),
        ),
        guard="horizontal directions are divided by at least 1e-6 (light/sky.glsl@analytic)",
        camera=Camera(position=(0.0, 3.0, 0.0), pitch=-math.pi / 2, roll=1.0, fov=0.01),
        without={"light/sky.glsl": {"max(length(d.xz), 1e-6)) * u_air_horizon": "length(d.xz)) * u_air_horizon"}},
        missed_by=guards("light", "the_horizon_is_no_heading_straight_down"),
    ),
    HardCase(
        "the brightest disc, ten stops up",
        Scene(light=Light(sun_elevation=0.1, exposure=10.0)),
        guard="light is at most 65504, the greatest half float (light/sky.glsl@main, surface/main.glsl)",
        camera=Camera(position=(0.0, 5.0, 0.0), yaw=math.pi / 2, pitch=0.1, fov=0.1),
        without=BRIGHTEST,
    ),
    HardCase(
        "ten stops down at night",
        Scene(light=Light(sun_elevation=-math.pi / 2, exposure=-10.0), water=Water(ripples=Ripples())),
        guard="the air's light is at least 0.002 (effects/light/atmosphere.py)",
        without={"effects/light/atmosphere.py": {"NIGHT = 0.002": "NIGHT = 0.0"}},
        missed_by=guards("light", "no_night_is_black_in_half_floats"),
    ),
    HardCase(
        "sun setting through 0 degrees under a layered sky",
        Scene(light=Light(sun_elevation=0.0, exposure=-1.0, sky=Sky(haze=20.0)), water=Water(ripples=Ripples())),
        guard="an offset of 0.02 in the haze's air mass (light/sky.glsl@layered)",
        camera=Camera(position=(0.0, 3.0, 0.0), yaw=math.pi / 2, pitch=0.0),
        unseen="not needed: the sky's glow is a polynomial there",
    ),
    HardCase(
        "no lamp at all: the sun down, the moon not yet counted",
        Scene(
            light=Light(sun_elevation=-0.06, exposure=2.0, sky=Sky(moon=Moon(), stars=1.0)),
            water=Water(ripples=Ripples()),
        ),
        guard="moonlight starts at 0 at the elevation where sunlight reaches 0 (effects/light/atmosphere.py)",
        camera=Camera(position=(0.0, 3.0, 0.0), yaw=0.4, pitch=0.0),
        without={"effects/light/atmosphere.py": {"* dark * smooth(": "* smooth("}},
    ),
    HardCase(
        "fog on the eye",
        Scene(light=Light(visibility=50.0), waves=(ParametricWave(),)),
        guard="Newton steps never leave the slab of the waves (surface/march.glsl@march)",
        camera=Camera(position=(0.0, 1e5, 0.0), pitch=-0.5, fov=2.6),
        without={"lib/rays.glsl": {"max(tau - clamp(gap / rate, -limit, limit), least)": "tau - gap / rate"}},
    ),
)

CASES = {
    "sun and sky": Cases(
        always_visible="all other effects are seen by it; without it a scene is drawn in white on black", hard=_HARD
    )
}
