"""The closed space of shader variants: scenes and qualities that between them ask for every program there is."""

from collections.abc import Iterator, Sequence
from heapq import heapify, heappop, heapreplace
from itertools import combinations, product
from typing import get_args

from seafoam.effects import EFFECTS
from seafoam.framegraph.plan import Program
from seafoam.planner import FramePlan, make_geometry_plan, make_plan
from seafoam.quality import TIERS, Quality
from support.cases import cases_of
from support.exact import UNFILTERED, whole_plan
from support.scenes import (
    Boat,
    BreakerSaturation,
    Burst,
    Clouds,
    Drift,
    DriftSaturation,
    Foam,
    FrontSaturation,
    Gusts,
    HeightSaturation,
    Light,
    Look,
    Moon,
    ParametricWave,
    Ring,
    Ripples,
    Saturation,
    Scene,
    Sea,
    Shore,
    Sky,
    SlopeSaturation,
    Spray,
    Surf,
    SurfSaturation,
    Vortex,
    WakeSaturation,
    Water,
    WhitecapSaturation,
    load_preset,
    preset_names,
)

SATURATIONS: tuple[tuple[Saturation, ...], ...] = (
    (FrontSaturation(),),
    (FrontSaturation(group=(0.2, 0.6), constants="listing"),),
    (HeightSaturation(),),
    (FrontSaturation(), HeightSaturation()),
)


def qualities() -> Iterator[Quality]:
    """The tiers, the tests' exact quality, and every choice of a parameter that changes a program's text in kind."""
    yield from TIERS.values()
    yield UNFILTERED
    standard = TIERS["standard"]
    for method, filtered, ripples, target in product(
        ("mesh", "march"), (True, False), ("tile", "exact"), ("RGBA16F", "RGBA32F")
    ):
        surface = standard.surface.model_copy(update={"method": method, "filter": filtered})
        yield standard.model_copy(update={"surface": surface, "ripples": ripples, "target": target})
    yield standard.model_copy(update={"cube": "exact", "cloud_octaves": 2})
    for mask, taps in product(("u8", "half"), (4, 16)):
        yield standard.model_copy(update={"mask": mask, "foam_taps": taps})
    yield standard.model_copy(update={"foam_octaves": 1})
    yield standard.model_copy(update={"foam_relief": True})
    for wake, reflection, rays in (("map", "traced", 4), ("exact", "map", 1)):
        yield standard.model_copy(update={"wake": wake, "reflection": reflection, "boat_samples": rays})
    for size, tiles, digits, steps in ((64, 2, "half", 0), (128, 3, "float", 4), (512, 4, "half", 8)):
        yield standard.model_copy(
            update={"sea_size": size, "sea_tiles": tiles, "sea_digits": digits, "age_steps": steps}
        )
    for samples, most in ((1, 4), (1, 16), (4, 16)):
        yield standard.model_copy(update={"samples": samples, "samples_max": most})
    for caustics, filtered in (("photons", True), ("grid", False)):
        surface = standard.surface.model_copy(update={"filter": filtered})
        yield standard.model_copy(update={"caustics": caustics, "surface": surface})


def scenes() -> Iterator[Scene]:
    """Every slot file at least once, every join, every compile-time switch both ways.

    Scenes that only one effect needs are in its cases; here are those that need several together.
    """
    for effect in EFFECTS:
        yield from cases_of(effect).variants
    sea = load_preset("default").scene
    yield from foams(sea)
    yield sea.model_copy(update={"foam": None})
    yield sea.model_copy(update={"light": Light(sun_elevation=-0.2)})
    yield sea.model_copy(update={"light": None})
    yield sea.model_copy(update={"light": None, "foam": None})
    yield sea.model_copy(update={"water": Water()})
    yield sea.model_copy(update={"water": Water(depth=3.0)})
    yield sea.model_copy(update={"water": Water(depth=3.0, aeration=0.2)})
    for waves in ((), sea.waves):
        for light in (None, sea.light):
            yield sea.model_copy(update={"rings": (Ring(), Ring(every=30.0)), "waves": waves, "light": light})
    for look, blur in product(("textured", "filtered"), (0.0, 0.5)):
        slope = (SlopeSaturation(blur=blur),)
        foam = sea.foam.model_copy(update={"saturation": slope, "texture_second": 3.14, "look": look})
        yield sea.model_copy(update={"foam": foam})
    for look in get_args(Look):
        yield sea.model_copy(update={"foam": sea.foam.model_copy(update={"cells": True, "look": look})})
    by_height = sea.foam.model_copy(update={"saturation": (HeightSaturation(),)})
    yield Scene(shore=Shore(), foam=by_height, light=sea.light)
    left = (FrontSaturation(decay=3.0), SlopeSaturation())
    yield sea.model_copy(update={"foam": sea.foam.model_copy(update={"saturation": left})})
    yield from seas(sea)
    yield Scene()
    yield Scene(foam=Foam(), light=Light())
    yield Scene(waves=tuple(ParametricWave(wavelength=3.0 + i) for i in range(16)), foam=Foam())
    yield sea.model_copy(update={"foam": sea.foam.model_copy(update={"mask": "vac:2:64:7"})})
    yield sea.model_copy(
        update={"foam": sea.foam.model_copy(update={"saturation": (FrontSaturation(), SurfSaturation())})}
    )
    shore = Shore(size=200.0, smoothing=20.0)
    for light, saturation in product((Light(), None), ((SurfSaturation(),), (SurfSaturation(), HeightSaturation()))):
        foam = Foam(saturation=saturation, look="halftone" if light is None else "filtered")
        yield Scene(shore=shore, foam=foam, light=light)
        yield Scene(shore=shore, foam=foam, light=light, water=Water(aeration=0.2))
    yield Scene(shore=shore.model_copy(update={"surf": Surf(height=0.0)}))
    for sky in (None, Sky(), Sky(clouds=Clouds()), Sky(moon=Moon(), stars=1.0), Sky(clouds=Clouds(), moon=Moon())):
        for around, reflection in product((None, shore), ("sky", "cubemap")):
            low = -0.3 if sky is not None and sky.moon is not None else 0.3
            light = Light(sun_elevation=low, sky=sky, reflection=reflection)
            yield Scene(light=light, shore=around)
    yield sea.model_copy(update={"water": Water(ripples=Ripples(gusts=Gusts()))})
    yield from drifting(sea)
    yield from living(sea, shore)


def seas(parametric: Scene) -> Iterator[Scene]:
    """Both models of a sea, alone, with parametric waves, and without displacement along the surface."""
    for model in ("fft", "gerstner"):
        wind = Sea(model=model)
        yield parametric.model_copy(update={"sea": wind})
        yield Scene(sea=wind, foam=Foam(saturation=(WhitecapSaturation(),), look="halftone"), light=None)
        yield Scene(
            sea=wind,
            waves=parametric.waves,
            foam=Foam(saturation=(WhitecapSaturation(), FrontSaturation(), HeightSaturation()), combine="product"),
        )
        yield Scene(sea=wind.model_copy(update={"choppiness": 0.0}))


def foams(sea: Scene) -> Iterator[Scene]:
    """Every look of every saturation, fading, textured and in octaves."""
    for look, saturation in product(get_args(Look), SATURATIONS):
        for combine in ("max", "product") if len(saturation) > 1 else ("max",):
            foam = Foam(look=look, saturation=saturation, combine=combine)
            yield sea.model_copy(update={"foam": foam})
    for fade, texture, octaves in product((0.0, 0.3), (0.0, 0.3), (1, 3)):
        look = {"fade": fade, "texture": texture, "octaves": octaves}
        yield sea.model_copy(update={"foam": sea.foam.model_copy(update=look)})


def drifting(sea: Scene) -> Iterator[Scene]:
    """Foam that drifts, its mask carried or not, in cells or not."""
    for vortices, look, cells in product(((), (Vortex(), Vortex(speed=-0.5))), ("filtered", "halftone"), (False, True)):
        foam = Foam(saturation=(DriftSaturation(),), look=look, cells=cells)
        yield sea.model_copy(update={"drift": Drift(vortices=vortices), "foam": foam})


def living(sea: Scene, shore: Shore) -> Iterator[Scene]:
    """Glints, spray, views from below, boats and their mirror."""
    for specular in ("glint", "blinn_phong"):
        yield Scene(light=Light(specular=specular))
    rocky = shore.model_copy(update={"slope": 0.9})
    for light in (Light(), None):
        yield Scene(waves=sea.waves, spray=Spray(), light=light)
        yield Scene(shore=rocky, waves=sea.waves, spray=Spray(bursts=(Burst(),)), light=light)
        yield Scene(sea=Sea(wind=12.0), rings=(Ring(),), spray=Spray(), light=light)
        yield Scene(sea=Sea(model="gerstner", wind=12.0), waves=sea.waves, spray=Spray(bursts=(Burst(),)), light=light)
        yield Scene(spray=Spray(bursts=(Burst(),)), light=light)
        yield Scene(shore=shore, sea=Sea(wind=12.0), rings=(Ring(),), spray=Spray(steep=2.0), light=light)
    for light in (Light(), Light(sun_elevation=-0.3), None):
        yield Scene(waves=sea.waves, foam=sea.foam, water=Water(view_below=True, ripples=Ripples()), light=light)
        yield Scene(waves=sea.waves, foam=sea.foam, water=Water(depth=3.0, floor_tile=1.0), light=light)
    for sky in (None, Sky(clouds=Clouds())):
        yield Scene(shore=shore, light=Light(reflection="planar", sky=sky))
    fleet = (Boat(), Boat(kind="motor", centre=(20.0, -40.0)))
    wake = Foam(saturation=(WakeSaturation(),))
    mirror = Light(reflection="planar")
    for boats, light, coast in product((fleet[:1], fleet), (Light(), mirror, None), (None, shore)):
        yield Scene(boats=boats, foam=wake, light=light, shore=coast)
    yield Scene(boats=fleet, waves=sea.waves, light=mirror, water=Water(depth=5.0))
    yield Scene(boats=fleet, sea=Sea(), light=mirror, foam=Foam(saturation=(WakeSaturation(), WhitecapSaturation())))
    yield Scene(foam=wake)


def every_plan(one_in: int = 1) -> Iterator[FramePlan]:
    """Presets at every quality, and every scene at each tier; of both one in so many, along diagonals.

    The tests' exact quality is always there: some files are of nothing else.
    """
    for name in preset_names():
        yield make_plan(load_preset(name).scene, UNFILTERED)
        yield make_geometry_plan(load_preset(name).scene, TIERS["standard"])
    for (i, name), (j, quality) in product(enumerate(preset_names()), enumerate(qualities())):
        if (i + j) % one_in == 0:
            yield make_plan(load_preset(name).scene, quality)
    for (i, scene), (j, quality) in product(enumerate(scenes()), enumerate(TIERS.values())):
        if (i + j) % one_in == 0:
            yield make_plan(scene, quality)
    for scene in drifting(load_preset("default").scene):
        for ways, window in (("forward", 120.0), ("backward", 7.0), ("exact", 7.0)):
            yield make_plan(scene, TIERS["standard"].model_copy(update={"drift": ways, "drift_window": window}))
    # What a bound leaves out is drawn where that bound is tested.
    yield whole_plan(Scene(foam=Foam(saturation=(SurfSaturation(),))), TIERS["standard"])
    yield whole_plan(Scene(spray=Spray()), TIERS["standard"])
    for source in (SurfSaturation(), DriftSaturation(), WakeSaturation(), BreakerSaturation()):
        yield whole_plan(Scene(foam=Foam(saturation=(source,))), TIERS["standard"])


def _files(program: Program) -> set[str]:
    return {file.path for file in program.fragment.files}


def every_program(one_in: int = 1) -> dict[tuple[str, str], tuple[FramePlan, str, Program]]:
    """Each distinct program of :func:`every_plan` once, with a plan that asks for it.

    A program that stands whole in that for eyes under water of the same plan is not compiled by itself as well.
    """
    found: dict[tuple[str, str], tuple[FramePlan, str, Program]] = {}
    for plan in every_plan(one_in):
        for name, program in plan.programs.items():
            low = plan.programs.get(f"{name}, underwater")
            if low is not None and _files(program) <= _files(low):
                continue
            found.setdefault((program.vertex.sha256, program.fragment.sha256), (plan, name, program))
    return found


def traits(program: Program) -> frozenset[str | tuple[str, str]]:
    """What of a program can fail by itself: its files, every two of them, the values of its constants."""
    shaders = (program.vertex, program.fragment)
    files = sorted({file.path for shader in shaders for file in shader.files if file.path})
    constants = {line for shader in shaders for line in shader.text.splitlines() if line.startswith("const ")}
    return frozenset((*files, *combinations(files, 2), *constants))


def covering(programs: Sequence[Program]) -> list[int]:
    """Places of programs that between them have every trait of any: greedily, so few, not the fewest."""
    having = [traits(program) for program in programs]
    left = set().union(*having)
    gains = [(-len(traits), i) for i, traits in enumerate(having)]
    heapify(gains)
    chosen = []
    while left:
        # What a program adds only falls, so the first that still adds as much as it promised adds the most.
        _, i = gains[0]
        adds = -len(having[i] & left)
        if adds > gains[0][0]:
            heapreplace(gains, (adds, i))
        else:
            heappop(gains)
            chosen.append(i)
            left -= having[i]
    return chosen
