"""Open seas that tests draw and compute."""

from support.scenes import Foam, Scene, Sea, Water, WhitecapSaturation

SEAS = {
    "fft": Sea(wind=12.0, fetch=3e5, wind_direction=1.2),
    "gerstner": Sea(model="gerstner", wind=7.0, fetch=1e5, wind_direction=-0.4),
}


def seen(sea: Sea, depth: float | None = None, foam: bool = True) -> Scene:
    return Scene(
        sea=sea,
        water=Water(depth=depth),
        foam=Foam(saturation=(WhitecapSaturation(),), look="halftone") if foam else None,
    )
