"""Settings of the server: environment variables that begin with ``SEAFOAM_``."""

import os
from pathlib import Path

from pydantic import Field
from pydantic_settings import BaseSettings, SettingsConfigDict

from seafoam.render.service.limits import FrameLimits


def default_workers() -> int:
    """Half the number of cores, at most four: software GL uses several cores per frame, and a GPU needs no more."""
    return max(1, min(4, (os.cpu_count() or 1) // 2))


SERVED = {"cache_size": 1 << 30, "cache_memory": 64 << 20}
"""What ``seafoam serve`` sets where the environment does not; an application made by a program keeps nothing."""


class Settings(BaseSettings):
    """Settings of the server."""

    model_config = SettingsConfigDict(env_prefix="SEAFOAM_", extra="ignore", frozen=True)

    host: str = Field(default="127.0.0.1", description="Address to listen on")
    port: int = Field(default=8000, ge=0, le=65535, description="Port to listen on; 0 selects a free one")
    workers: int = Field(
        default_factory=default_workers, ge=1, le=64, description="Number of render workers (processes)"
    )
    queue: int | None = Field(
        default=None,
        ge=0,
        le=10_000,
        description="Capacity of the render queue, frames; absent: twice the number of workers",
    )
    deadline: float = Field(default=10.0, gt=0.0, le=3600.0, description="Timeout of a frame, waiting included, s")
    recycle: int = Field(default=1000, ge=0, description="Number of frames after which a worker is replaced; 0: never")
    device_index: int | None = Field(
        default=None, ge=0, description="Index of the EGL device to render on; absent: the first"
    )
    max_side: int = Field(default=4096, ge=1, le=16384, description="Maximum width and height of a frame, pixels")
    max_sampled_side: int = Field(
        default=8192,
        ge=1,
        le=32768,
        description="Maximum width and height of the render target, samples; limited by the GL implementation",
    )
    max_samples: int = Field(default=8_400_000, ge=1, description="Maximum of width × height × samples per pixel")
    max_body: int = Field(default=262_144, ge=1024, description="Maximum size of a request body, bytes")

    accuracy_width: int = Field(
        default=160, ge=16, le=640, description="Width of the pictures compared when accuracy is measured, pixels"
    )
    accuracy_height: int = Field(default=90, ge=16, le=360, description="Height of these pictures, pixels")
    accuracy_samples: int = Field(
        default=16, ge=2, le=32, description="Samples along each side of a pixel in the float64 reference"
    )
    accuracy_rounds: int = Field(default=7, ge=2, le=100, description="Number of timed rounds per quality")
    sequences_waiting: int = Field(default=4, ge=1, le=1000, description="Maximum number of unfinished sequences")
    sequences_kept: int = Field(default=8, ge=1, le=10_000, description="Maximum number of finished sequences on disk")
    sequence_frames: int = Field(default=3600, ge=1, le=1_000_000, description="Maximum number of frames of a sequence")
    cache: Path | None = Field(
        default=None,
        description="Directory for measurements, frames and sequences; absent: the system's cache directory",
    )
    cache_size: int = Field(
        default=0,
        ge=0,
        description="Maximum size of the frames on disk, bytes; 0: none. `seafoam serve` sets 1 GiB if absent",
    )
    cache_memory: int = Field(
        default=0,
        ge=0,
        description="Maximum size of the frames in memory, bytes; 0: none. `seafoam serve` sets 64 MiB if absent",
    )

    @property
    def served(self) -> "Settings":
        """Return these settings with :data:`SERVED` for those that were not given."""
        absent = {name: value for name, value in SERVED.items() if name not in self.model_fields_set}
        return self.model_copy(update=absent)

    @property
    def frame_limits(self) -> FrameLimits:
        """Return the limits of one frame."""
        return FrameLimits(self.max_side, self.max_sampled_side, self.max_samples)
