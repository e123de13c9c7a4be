"""Options of commands that draw frames. Absent ones are None: the preset's, or the default that the text names."""

from pathlib import Path
from typing import Annotated

import typer

Preset = Annotated[str, typer.Argument(help="Name of a preset; `seafoam presets` lists them.")]
PresetName = Annotated[str | None, typer.Argument(help="Name of a preset; `seafoam presets` lists them.")]
Picture = Annotated[Path | None, typer.Option("--output", "-o", help="Output file; the extension selects the format.")]
Again = Annotated[
    Path | None,
    typer.Option(help="Draw this picture from its recipe, and say what differs. Exit code 0: the same bytes."),
]
Time = Annotated[float | None, typer.Option(help="Time, s (default: the preset's).")]
Size = Annotated[str | None, typer.Option(help="WIDTHxHEIGHT in pixels (default: the preset's).")]
QualityName = Annotated[
    str | None,
    typer.Option(
        help="fast, standard, high, reference, or auto: the most exact that fits --budget-ms (default: standard)."
    ),
]
TierName = Annotated[str, typer.Option(help="fast, standard, high or reference.")]
Budget = Annotated[
    float | None, typer.Option(help="With auto: maximum frame time, ms. The first use measures, which takes minutes.")
]
LookName = Annotated[str | None, typer.Option(help="Foam look (default: the preset's).")]
MaskName = Annotated[
    str | None,
    typer.Option(help="Foam mask: a shipped one, or family:sigma:size:seed[:aspect:age] (default: the preset's)."),
]
X = Annotated[
    float | None, typer.Option(help="Camera position along +x, m (default: the preset's, as for all camera options).")
]
Y = Annotated[float | None, typer.Option(help="Camera height above still water, m.")]
Z = Annotated[float | None, typer.Option(help="Camera position along +z, m.")]
Yaw = Annotated[float | None, typer.Option(help="Camera yaw, rad from -z toward +x.")]
Pitch = Annotated[float | None, typer.Option(help="Camera pitch, rad; positive looks up.")]
Roll = Annotated[float | None, typer.Option(help="Camera roll about the view axis, rad.")]
Fov = Annotated[float | None, typer.Option(help="Vertical field of view, rad.")]
Dither = Annotated[
    bool | None,
    typer.Option(
        "--dither/--no-dither",
        help="Of .png and .webp: dither 8 bits from 16, or round as the page does (default: dither).",
    ),
]
Numbers = Annotated[str | None, typer.Option(help="Of .exr: half or float (default: half).")]
