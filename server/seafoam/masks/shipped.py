"""The shipped masks and their descriptions."""

from dataclasses import dataclass

from seafoam.masks.families import Family, Method

SHIPPED_SIZE = 512
SHIPPED_SEED = 2011
SHIPPED_METHOD: Method = "exact"
"""How `vac` is ordered for the catalogue: a mask is baked once, so time is no object."""
_READING = "The paper's arrays were never published; this is our reading of its description."
FAMILY_TITLES: dict[Family, str] = {
    "vac": "Void and cluster",
    "blur": "Filtered white noise",
    "clump": "Clumps",
    "bubble": "Bubbles",
    "mix": "Clustered bubbles",
    "lace": "Lace",
}
FAMILY_SUMMARIES: dict[Family, str] = {
    "vac": f"Dots spread by void-and-cluster; a wider Gaussian lets them come closer and leave gaps. {_READING}",
    "blur": f"White noise filtered by a Gaussian: patches as wide as the filter. {_READING} Its spectra speak "
    "against this one, which is kept for comparison.",
    "clump": "Band-passed noise: irregular lace that magnifies smoothly. Not from the paper.",
    "bubble": "Unions of discs that shrink and go out as saturation falls. Not from the paper.",
    "mix": "Clusters of round bubbles with open water between; cover is patchy by design. Not from the paper.",
    "lace": "The walls of a foam of large and small cells: holes grow and merge as saturation falls, and threads of "
    "foam go last. Not from the paper.",
}


@dataclass(frozen=True, slots=True)
class ShippedMask:
    """One baked mask: its name and how it is made at :data:`SHIPPED_SIZE` from :data:`SHIPPED_SEED`."""

    name: str
    family: Family
    sigma: float
    aspect: float = 1.0
    age: float = 0.0


SHIPPED: tuple[ShippedMask, ...] = (
    ShippedMask("vac-1.5", "vac", 1.5),
    ShippedMask("vac-3", "vac", 3.0),
    ShippedMask("vac-6", "vac", 6.0),
    ShippedMask("vac-12", "vac", 12.0),
    ShippedMask("vac-24", "vac", 24.0),
    ShippedMask("blur-1.5", "blur", 1.5),
    ShippedMask("blur-6", "blur", 6.0),
    ShippedMask("blur-24", "blur", 24.0),
    ShippedMask("clump", "clump", 1.5),
    ShippedMask("bubble", "bubble", 4.0),
    ShippedMask("mix", "mix", 4.0),
    ShippedMask("lace", "lace", 10.0),
    ShippedMask("lacetorn", "lace", 15.0, aspect=1.3, age=1.0),
    ShippedMask("streak", "lace", 11.0, aspect=3.0, age=0.7),
)
