"""Section 1: the camera, and the rays of its samples."""

import math

import numpy as np

from seafoam.reference.types import Floats, Pair, Vec2
from seafoam.scene import Camera


class SampleGrid:
    """The samples of a camera's picture of width × height pixels, ``samples`` along each side of one, and the vectors
    of which their rays are composed. Rotated by yaw, then pitch, then roll."""

    def __init__(self, camera: Camera, width: int, height: int, samples: int = 1) -> None:
        self.width, self.height, self.samples = width, height, samples
        self.columns, self.rows = samples * width, samples * height
        sin_yaw, cos_yaw = math.sin(camera.yaw), math.cos(camera.yaw)
        sin_pitch, cos_pitch = math.sin(camera.pitch), math.cos(camera.pitch)
        sin_roll, cos_roll = math.sin(camera.roll), math.cos(camera.roll)
        right = np.array([cos_yaw, 0.0, sin_yaw])
        up = np.array([-sin_yaw * sin_pitch, cos_pitch, cos_yaw * sin_pitch])
        right, up = right * cos_roll + up * sin_roll, up * cos_roll - right * sin_roll
        q = math.tan(camera.fov / 2.0)
        self.eye: Floats = np.array(camera.position, np.float64)  # m
        x, self.eye_y, z = (float(part) for part in camera.position)
        self.origin: Vec2 = x, z  # the point below the camera, m
        # Derivatives of a ray by clip X and Y, and the ray through the centre of the picture.
        self.ray_x: Floats = q * (width / height) * right
        self.ray_y: Floats = q * up
        self.ray_z: Floats = np.array([sin_yaw * cos_pitch, sin_pitch, -cos_yaw * cos_pitch])
        # Change of a ray from one sample to the next, along a row and along a column; (3,) each.
        self.steps: Pair = 2.0 * self.ray_x / self.columns, 2.0 * self.ray_y / self.rows

    @property
    def depression(self) -> Floats:
        """Angle of each pixel's middle ray below the horizon, (height, width) rad, row 0 at the top."""
        X, Y = (2.0 * (np.arange(count) + 0.5) / count - 1.0 for count in (self.width, self.height))
        D = self.rays(*np.meshgrid(X, -Y))
        return np.arctan2(-D[..., 1], np.hypot(D[..., 0], D[..., 2]))

    def rays(self, X: Floats, Y: Floats) -> Floats:
        """D = ray_z + X ray_x + Y ray_y at clip positions in [−1, 1]; (..., 3), not normalised, never zero."""
        return self.ray_z + X[..., None] * self.ray_x + Y[..., None] * self.ray_y
