"""Start positions of spray on a shore's rocks. docs/formulae.md, section 13."""

from typing import ClassVar

from pydantic import Field, field_validator

from seafoam.ocean.rocks import rocks
from seafoam.scene.shore import Shore
from seafoam.textures.spec import Image, TextureSpec


class SprayRocks(TextureSpec):
    """Places on a shore's rocks, RGBA32F (1, ROCKS), see :func:`seafoam.ocean.rocks.rocks`."""

    kind: ClassVar[str] = "spray-rocks"

    shore: Shore
    steep: float = Field(ge=0.0, le=2.0)

    @field_validator("shore")
    @classmethod
    def _ground_alone(cls, shore: Shore) -> Shore:
        return shore.ground

    def image(self) -> Image:
        """Return the places as a row. Raises ``ValueError`` where there are none."""
        places = rocks(self.shore, self.steep)
        if len(places) == 0:
            raise ValueError("shore: has no rocks as steep as that")
        return Image("RGBA32F", (places.astype("<f4")[None],))
