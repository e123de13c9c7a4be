"""Commands of masks: ``seafoam masks``."""

import json
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from seafoam.cli.support import OUTPUT, CommandError, extension_of, print_table, progress_bar, say, write
from seafoam.extras import require

if TYPE_CHECKING:
    from seafoam.masks.catalogue import Mask

masks = typer.Typer(help="Halftone masks: list the shipped ones, make new ones, measure them.", no_args_is_help=True)


@masks.command("list")
def list_masks() -> None:
    """List the shipped masks."""
    from seafoam.masks.catalogue import load_catalogue

    rows = []
    for name, entry in load_catalogue().items():
        made = entry.parameters
        sizes = f"{made.sigma:g}", str(made.width), str(made.seed)
        rows.append((name, entry.family, *sizes, entry.sha256[:12], entry.title))
    print_table(rows, "name", "family", "sigma", "size", "seed", "sha256", "title")


@masks.command("make")
def make_mask(
    output: Annotated[Path, OUTPUT],
    family: Annotated[str, typer.Option(help="vac, blur, clump, bubble, mix or lace.")] = "vac",
    sigma: Annotated[
        float | None, typer.Option(help="Characteristic length, texels (default: depends on the family).")
    ] = None,
    size: Annotated[str, typer.Option(help="Side of the tile, or WIDTHxHEIGHT: 32 to 1024 texels each.")] = "512",
    seed: Annotated[int, typer.Option(help="Random seed.")] = 0,
    aspect: Annotated[float, typer.Option(help="Aspect ratio of the cells along x, 1 to 6 (lace only).")] = 1.0,
    age: Annotated[float, typer.Option(help="Age of the foam, 0 (young) to 1 (old and torn) (lace only).")] = 0.0,
    method: Annotated[
        str, typer.Option(help="Ordering of vac: exact (minutes) or batched (seconds; minutes for a wide sigma).")
    ] = "batched",
    bits: Annotated[int, typer.Option(help="Bits per texel of a .png: 16 or 8.")] = 16,
) -> None:
    """Make a mask and write it as .png, .npy (float32 thresholds), .u16 (raw) or .dds (R16_UNORM)."""
    from seafoam.masks import families, formats
    from seafoam.masks.construct import make as construct

    encoders = {
        "png": formats.to_png16 if bits == 16 else formats.to_png8,
        "npy": formats.to_npy,
        "u16": formats.to_u16,
        "dds": formats.to_dds,
    }
    encoder = encoders[extension_of(output, tuple(encoders))]
    if bits not in (8, 16):
        raise CommandError(f"--bits: must be one of 8, 16, not {bits}")
    with progress_bar() as bar:
        task = bar.add_task(family, total=1.0)
        try:
            ranks = construct.make_mask(
                family,
                sigma=sigma,
                size=families.parse_size(size),
                seed=seed,
                aspect=aspect,
                age=age,
                method=method,
                progress=lambda share: bar.update(task, completed=share),
            )
        except ValueError as error:
            raise CommandError(f"--{error}") from error
    content = encoder(ranks)
    write(output, content)
    height, width = ranks.shape
    say(f"{output}: {family}, {width} × {height}, {len(content):,} bytes")


@masks.command("spectrum")
def mask_spectrum(
    name: Annotated[str, typer.Argument(help="A shipped mask, or family:sigma:size:seed[:aspect:age].")],
    output: Annotated[Path | None, typer.Option("--output", "-o", help="Plot to write, a .png file.")] = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print the spectrum as JSON.")] = False,
) -> None:
    """Measure the spectrum of a mask: radially averaged power and anisotropy, as a plot or as JSON."""
    if (output is None) == (not as_json):
        raise CommandError("--output or --json: exactly one is required")
    mask = mask_of(name)
    if output is None:
        say(json.dumps(mask.tables.spectrum.model_dump()))
        return
    require("reports")
    from seafoam.masks.judge.plots import plot_spectrum

    extension_of(output, ("png",))
    write(output, plot_spectrum(mask.tables.spectrum, mask.entry.title))
    say(f"{output}: spectrum of {mask.entry.title}")


@masks.command("shapes")
def mask_shapes(
    name: Annotated[str, typer.Argument(help="A shipped mask, or family:sigma:size:seed[:aspect:age].")],
    as_json: Annotated[bool, typer.Option("--json", help="Print as JSON.")] = False,
) -> None:
    """Measure the foam shapes of a mask by saturation: connected components, holes and chord lengths, in texels."""
    shapes = mask_of(name).tables.morphology
    if as_json:
        say(json.dumps(shapes.model_dump()))
        return
    columns = ("saturation", "largest component", "Euler number", "holes 10 / 50 / 90 %", "foam chord", "water chord")
    rows = []
    for entry in shapes.saturations:
        holes = " / ".join(f"{diameter:.0f}" for diameter in entry.hole_diameters)
        chords = f"{entry.foam_chord:.1f}", f"{entry.water_chord:.1f}"
        pieces = f"{entry.largest_piece:.2f}", str(entry.euler_number)
        rows.append((f"{entry.saturation:g}", *pieces, holes, *chords))
    print_table(rows, *columns)
    say(f"At saturation {shapes.joined_from:g} and above, one component holds more than half of the foam.")


def mask_of(name: str) -> "Mask":
    from seafoam.masks.catalogue import UnknownMaskError, load_catalogue, mask_by_name
    from seafoam.masks.families import TEXT_FORM

    try:
        return mask_by_name(name)
    except UnknownMaskError:
        known = ", ".join(load_catalogue())
        raise CommandError(f"NAME: mask {name!r} was not found; available: {known}, or {TEXT_FORM}") from None
    except ValueError as error:
        raise CommandError(f"NAME: {error}") from error
