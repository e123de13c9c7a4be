"""Settings of the server: environment variables that begin with ``SEAFOAM_``."""

import os
import re
from ipaddress import ip_network
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import Field, SecretStr, field_validator, model_validator
from pydantic_settings import BaseSettings, NoDecode, SettingsConfigDict

from seafoam.api.guard.keys import Access, Signing, api_keys_of
from seafoam.api.guard.proxy_headers import ROOT_PATH
from seafoam.described import Described
from seafoam.numerals import numeral_fields
from seafoam.render.service.errors import FrameLimits


def default_workers() -> int:
    """Half the number of cores, at most four: software GL uses several cores per frame, and a GPU needs no more."""
    return max(1, min(4, (os.cpu_count() or 1) // 2))


class Settings(Described, BaseSettings):
    """Settings of the server."""

    model_config = SettingsConfigDict(env_prefix="SEAFOAM_", extra="ignore", frozen=True)

    host: str = Field(default="127.0.0.1", description="Address to listen on")
    port: int = Field(default=8000, ge=0, le=65535, description="Port to listen on; 0 selects a free one")
    workers: int = Field(default_factory=default_workers, ge=1, le=64)
    """Number of render workers (processes)"""
    queue: int | None = Field(default=None, ge=0, le=10_000)
    """Capacity of the render queue, frames; absent: twice the number of workers"""
    streams: int = Field(default_factory=lambda: os.cpu_count() or 1, ge=0, le=1000)
    """Number of streams of frames that pages may have at once; 0: none. Absent: the number of cores"""
    deadline: float = Field(default=10.0, gt=0.0, le=3600.0, description="Timeout of a frame, waiting included, s")
    recycle: int = Field(default=20_000, ge=0)
    """Number of frames after which a worker is replaced; 0: never"""
    device_index: int | None = Field(default=None, ge=0)
    """Index of the EGL device to render on; absent: the first"""
    max_side: int = Field(default=4096, ge=1, le=16384, description="Maximum width and height of a frame, pixels")
    max_sampled_side: int = Field(default=8192, ge=1, le=32768)
    """Maximum width and height of the render target, samples; limited by the GL implementation"""
    max_samples: int = Field(default=8_400_000, ge=1, description="Maximum of width × height × samples per pixel")
    max_body: int = Field(default=262_144, ge=1024, description="Maximum size of a request body, bytes")

    accuracy_width: int = Field(default=160, ge=16, le=640)
    """Width of the pictures compared when accuracy is measured, pixels"""
    accuracy_height: int = Field(default=90, ge=16, le=360, description="Height of these pictures, pixels")
    accuracy_samples: int = Field(default=16, ge=2, le=32)
    """Samples along each side of a pixel in the float64 reference"""
    accuracy_rounds: int = Field(default=7, ge=2, le=100, description="Number of timed rounds per quality")
    sequences_waiting: int = Field(default=4, ge=1, le=1000, description="Maximum number of unfinished sequences")
    sequences_kept: int = Field(default=8, ge=1, le=10_000, description="Maximum number of finished sequences on disk")
    sequence_frames: int = Field(default=3600, ge=1, le=1_000_000, description="Maximum number of frames of a sequence")
    cache: Path | None = None
    """Directory for measurements, frames and sequences; absent: the system's cache directory"""
    cache_size: int = Field(default=1 << 30, ge=0, description="Maximum size of the frames on disk, bytes; 0: none")
    cache_memory: int = Field(default=64 << 20, ge=0)
    """Maximum size of the frames in memory, bytes; 0: none"""
    compile_ahead: bool = True
    """Whether a process of the least priority compiles the programs of all presets for the driver's cache on disk"""

    canary: float = Field(default=60.0, gt=0.0, le=3600.0)
    """Interval at which an idle renderer draws its test picture, s"""
    ready_age: float = Field(default=180.0, gt=0.0, le=86_400.0)
    """Age of the last picture from which /readyz answers 503, s; at least twice the canary's interval"""

    api_keys: SecretStr = SecretStr("")
    """Keys that the API asks for, as name:key,name:key; a key has 16 characters or more. Absent: none"""
    signing_key: SecretStr = SecretStr("")
    """Key of signed links, 16 bytes or more in hexadecimal digits; absent: none"""
    signing_salt: SecretStr = SecretStr("")
    """Salt of signed links, in hexadecimal digits; given with the key"""
    rate: float = Field(default=0.0, ge=0.0, le=1e6)
    """Requests to the API that a client may make, 1/s; 0: any number"""
    rate_burst: int = Field(default=200, ge=1, le=1_000_000)
    """Requests to the API that a client may make at once after a pause"""
    root_path: str = Field(default="", pattern=f"^{ROOT_PATH}/?$")
    """Path below which a proxy, which strips it, serves this server, such as /water; absent: the root"""
    trusted_proxies: Annotated[tuple[str, ...], NoDecode] = ("127.0.0.1",)
    """Addresses and networks of proxies whose X-Forwarded-For, X-Forwarded-Proto and X-Forwarded-Prefix are believed,
    with commas between; empty: none"""
    cors_origins: Annotated[tuple[str, ...], NoDecode] = ()
    """Origins of other pages that may use the API, such as https://example.org, with commas between; *: any; absent:
    none"""
    log_format: Literal["text", "json"] = "text"
    """Form of the log: text, or json with an object for each line and request"""

    _numerals = field_validator("*", mode="before")(numeral_fields)

    @field_validator("trusted_proxies", "cors_origins", mode="before")
    @classmethod
    def _listed(cls, value: Any) -> Any:
        return tuple(part.strip() for part in value.split(",") if part.strip()) if isinstance(value, str) else value

    @field_validator("trusted_proxies")
    @classmethod
    def _networks(cls, value: tuple[str, ...]) -> tuple[str, ...]:
        for part in value:
            ip_network(part)
        return value

    @field_validator("cors_origins")
    @classmethod
    def _origins(cls, value: tuple[str, ...]) -> tuple[str, ...]:
        for part in value:
            if part != "*" and not re.fullmatch(r"https?://[^\s/?#@]+", part):
                raise ValueError(f"{part!r} is not an origin: scheme, host and port")
        return value

    @field_validator("api_keys")
    @classmethod
    def _keys(cls, value: SecretStr) -> SecretStr:
        api_keys_of(value.get_secret_value())
        return value

    @model_validator(mode="after")
    def _signed(self) -> "Settings":
        _ = self.access  # raises what is wrong with the key of signed links
        if self.ready_age < 2 * self.canary:
            raise ValueError(f"ready_age must be at least twice canary, which is {self.canary:g} s")
        return self

    @property
    def access(self) -> Access:
        signing = Signing.of(self.signing_key.get_secret_value(), self.signing_salt.get_secret_value())
        return Access(api_keys_of(self.api_keys.get_secret_value()), signing)

    @property
    def frame_limits(self) -> FrameLimits:
        return FrameLimits(self.max_side, self.max_sampled_side, self.max_samples)
