"""Section 1: the camera, and the rays of its samples."""

import math
from dataclasses import dataclass

import numpy as np

from seafoam.reference.types import Floats
from seafoam.scene.camera import Camera


@dataclass(frozen=True)
class View:
    """A camera's position and the three vectors of which rays are composed."""

    eye: Floats
    """(3,) position, m."""
    ray_x: Floats
    """(3,) derivative of a ray by clip X."""
    ray_y: Floats
    """(3,) derivative of a ray by clip Y."""
    ray_z: Floats
    """(3,) the ray through the centre of the picture."""


def basis(yaw: float, pitch: float, roll: float) -> tuple[Floats, Floats, Floats]:
    """Right, up and forward, (3,) unit vectors, of a camera rotated by yaw, pitch and roll (rad)."""
    sin_yaw, cos_yaw = math.sin(yaw), math.cos(yaw)
    sin_pitch, cos_pitch = math.sin(pitch), math.cos(pitch)
    forward = np.array([sin_yaw * cos_pitch, sin_pitch, -cos_yaw * cos_pitch])
    right = np.array([cos_yaw, 0.0, sin_yaw])
    up = np.array([-sin_yaw * sin_pitch, cos_pitch, cos_yaw * sin_pitch])
    return (
        right * math.cos(roll) + up * math.sin(roll),
        up * math.cos(roll) - right * math.sin(roll),
        forward,
    )


def view(camera: Camera, width: int, height: int) -> View:
    """The view of a camera on a picture of width × height pixels."""
    right, up, forward = basis(camera.yaw, camera.pitch, camera.roll)
    q = math.tan(camera.fov / 2.0)
    return View(np.array(camera.position, np.float64), q * (width / height) * right, q * up, forward)


def rays(of: View, X: Floats, Y: Floats) -> Floats:
    """D = ray_z + X ray_x + Y ray_y at clip positions in [−1, 1]; (..., 3), not normalised, never zero."""
    result: Floats = of.ray_z + X[..., None] * of.ray_x + Y[..., None] * of.ray_y
    return result


def depression(of: View, width: int, height: int) -> Floats:
    """Angle of each pixel's middle ray below the horizon, (height, width) rad, row 0 at the top."""
    X = 2.0 * (np.arange(width) + 0.5) / width - 1.0
    Y = 1.0 - 2.0 * (np.arange(height) + 0.5) / height
    D = rays(of, *np.broadcast_arrays(X[None, :], Y[:, None]))
    result: Floats = np.arctan2(-D[..., 1], np.hypot(D[..., 0], D[..., 2]))
    return result
