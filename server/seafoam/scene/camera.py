"""The camera of a scene."""

from typing import Annotated

from pydantic import Field

from seafoam.scene.base import Angle, Elevation, Part, Place, Radians


class Camera(Part):
    """A pinhole camera. Yaw 0 looks toward −z, a positive yaw turns toward +x, a positive pitch looks up."""

    position: tuple[Place, Annotated[float, Field(ge=-1000.0, le=1e5)], Place] = (0.0, 6.0, 0.0)
    """Position of the camera, m; y is measured from still water"""
    yaw: Angle = Field(default=0.0, description="Yaw, rad from −z toward +x")
    pitch: Elevation = Field(default=-0.15, description="Pitch, rad; positive looks up")
    roll: Radians = Field(default=0.0, ge=-3.1416, le=3.1416, description="Roll about the view axis, rad")
    fov: Radians = Field(default=0.8727, ge=0.01, le=2.6, description="Vertical field of view, rad")
