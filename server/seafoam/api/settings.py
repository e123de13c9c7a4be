"""What the operator may set: environment variables that begin with ``SEAFOAM_``."""

import os
from pathlib import Path

from pydantic import Field
from pydantic_settings import BaseSettings, SettingsConfigDict

from seafoam.render.service.pool import FrameLimits


def default_workers() -> int:
    """Half the cores, up to four: software GL uses several cores a frame, a GPU gains nothing from more."""
    return max(1, min(4, (os.cpu_count() or 1) // 2))


class Settings(BaseSettings):
    """Settings of the server."""

    model_config = SettingsConfigDict(env_prefix="SEAFOAM_", extra="ignore", frozen=True)

    host: str = Field(default="127.0.0.1", description="Address to listen on")
    port: int = Field(default=8000, ge=0, le=65535, description="Port to listen on; 0 takes a free one")
    workers: int = Field(default_factory=default_workers, ge=1, le=64, description="Render processes")
    queue: int | None = Field(
        default=None, ge=0, le=10_000, description="Frames that may wait for a worker; absent: twice the workers"
    )
    deadline: float = Field(default=10.0, gt=0.0, le=3600.0, description="Seconds a frame may take, waiting included")
    recycle: int = Field(default=1000, ge=0, description="Frames after which a worker is replaced; 0: never")
    device_index: int | None = Field(default=None, ge=0, description="EGL device to render on; absent: the first")
    max_side: int = Field(default=4096, ge=1, le=16384, description="Greatest width and height of a frame, pixels")
    max_sampled_side: int = Field(
        default=8192, ge=1, le=32768, description="Greatest width and height in samples, what the GL can draw into"
    )
    max_samples: int = Field(default=8_400_000, ge=1, description="Greatest width × height × samples a pixel")
    max_body: int = Field(default=262_144, ge=1024, description="Greatest request body, bytes")

    accuracy_width: int = Field(
        default=160, ge=16, le=640, description="Width of the pictures that the cost of accuracy is measured on, pixels"
    )
    accuracy_height: int = Field(default=90, ge=16, le=360, description="Their height, pixels")
    accuracy_samples: int = Field(
        default=16, ge=2, le=32, description="Samples along each side of a pixel of the float64 truth"
    )
    accuracy_rounds: int = Field(default=7, ge=2, le=100, description="Times that each quality is timed")
    cache: Path | None = Field(
        default=None, description="Folder of measurements; absent: the system's place for caches"
    )

    @property
    def frame_limits(self) -> FrameLimits:
        """The limits of one frame."""
        return FrameLimits(self.max_side, self.max_sampled_side, self.max_samples)
