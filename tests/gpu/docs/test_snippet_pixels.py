"""The pixels of docs/snippets on a plane in perspective, against 256 samples a pixel."""

import math
import re
from pathlib import Path
from typing import Any

import moderngl
import numpy as np
import pytest
from numpy.typing import NDArray

from seafoam.masks.catalogue import load_mask
from seafoam.masks.formats import quantised, to_u16
from seafoam.masks.torus import Ranks
from seafoam.render.gl.executor import Executor
from support.probe import WHOLE, Probe
from support.report import Report

SNIPPETS = Path(__file__).parents[3] / "docs" / "snippets"
Picture = NDArray[np.float64]
WIDTH, HEIGHT, SAMPLES = 160, 90, 16
SIDE = 512
PLACE = f"""
// Repeats of the mask, 12 m each, on water 3 m below a camera that looks down by 0.55 rad and is rolled by 0.2.
vec2 place(vec2 pixel) {{
    vec2 screen = (pixel - vec2({WIDTH}.0, {HEIGHT}.0) / 2.0) * (2.0 * tan(0.45) / {HEIGHT}.0);
    screen = mat2(cos(0.2), sin(0.2), -sin(0.2), cos(0.2)) * screen;
    vec3 ray = vec3(screen.x, cos(0.55) * screen.y - sin(0.55), sin(0.55) * screen.y + cos(0.55));
    return mat2(0.8, 0.6, -0.6, 0.8) * (ray.xz / -ray.y * 0.25);
}}
"""
HARD = "texelFetch(u_mask, ivec2(fract(uv) * vec2(textureSize(u_mask, 0))), 0).r < u_saturation ? 1.0 : 0.0"


def deviations(ranks: Ranks) -> Picture:
    """By level: root mean square of the standard deviation of the thresholds inside a box of 2^level texels."""
    side, u = len(ranks), (ranks + 0.5) / ranks.size
    sizes = [2**level for level in range(side.bit_length())]
    return np.sqrt([u.reshape(-1, size, side // size, size).var(axis=(1, 3)).mean() for size in sizes])


def snippet_of(ranks: Ranks) -> str:
    """The snippet with the numbers of another mask, as the mask laboratory shows it."""
    own = (math.sqrt(3.0) * deviations(ranks)).tolist()
    numbers = ", ".join(f"{value:.3f}" for value in [*own, *[0.5] * (11 - len(own))])
    return re.sub(r"float\[11\]\([\d., ]+\)", f"float[11]({numbers})", (SNIPPETS / "foam.glsl").read_text())


def render(executor: Executor, text: str, mask: moderngl.Texture, uniforms: dict[str, Any], samples: int) -> Picture:
    """What a fragment shader draws, as the mean of samples² a pixel; (HEIGHT, WIDTH, 3)."""
    context = executor._context
    program = context.program(vertex_shader=WHOLE.text, fragment_shader=text)
    target = context.texture((WIDTH * samples, HEIGHT * samples), 4, dtype="f4")
    framebuffer = context.framebuffer([target])
    framebuffer.use()
    mask.use(0)
    for name, value in uniforms.items():
        program[name] = value
    array = context.vertex_array(program, [])
    array.render(moderngl.TRIANGLES, vertices=3)
    raw = np.frombuffer(framebuffer.read(components=3, dtype="f4"), np.float32)
    assert context.error == "GL_NO_ERROR"
    context.framebuffer([context.texture((1, 1), 4)]).use()
    for item in (array, framebuffer, target, program):
        item.release()
    return raw.astype(np.float64).reshape(HEIGHT, samples, WIDTH, samples, 3).mean(axis=(1, 3))


def drawn(executor: Executor, ranks: Ranks, saturation: float, value: str, samples: int = 1) -> Picture:
    """A picture of ``value``, GLSL of ``u_saturation`` and ``uv``."""
    text = (
        f"#version 300 es\nprecision highp float;\n{snippet_of(ranks)}{PLACE}uniform float u_saturation;\n"
        f"out vec4 o_colour;\nvoid main() {{\n vec2 uv = place(gl_FragCoord.xy / {samples}.0);\n"
        f" o_colour = vec4({value});\n}}\n"
    )
    mask = executor._context.texture((SIDE, SIDE), 1, to_u16(ranks), dtype="nu2")
    mask.build_mipmaps()
    mask.filter = (moderngl.NEAREST_MIPMAP_NEAREST, moderngl.NEAREST)
    return render(executor, text, mask, {"u_mask": 0, "u_saturation": saturation}, samples)


def error(picture: Picture, truth: Picture) -> float:
    """Root mean square difference, levels of 255."""
    return 255.0 * float(np.sqrt(((picture - truth) ** 2).mean()))


@pytest.mark.parametrize(("name", "bound"), [("vac-24", 14.0), ("vac-1.5", 15.5), ("mix", 9.5), ("lace", 10.0)])
def test_sixteen_taps_are_near_256_samples(executor: Executor, report: Report, name: str, bound: float) -> None:
    ranks = load_mask(name).ranks
    truth = drawn(executor, ranks, 0.3, HARD, SAMPLES)
    snippet = drawn(executor, ranks, 0.3, "foam(u_saturation, uv)")
    errors = {"hard": error(drawn(executor, ranks, 0.3, HARD), truth), "snippet": error(snippet, truth)}
    report.add(
        "Coverage of a plane at saturation 0.3 against 256 samples a pixel, levels of 255 (docs/masks.md)",
        mask=name,
        **{look: f"{value:.1f}" for look, value in errors.items()},
    )
    assert errors["snippet"] <= bound
    assert errors["hard"] > 7.0 * errors["snippet"]
    assert abs(snippet.mean() - truth.mean()) < 0.004
    for whole in (0.0, 1.0):
        assert np.abs(drawn(executor, ranks, whole, "foam(u_saturation, uv)") - whole).max() < 1e-6


def test_shadertoy_draws_as_pasted(executor: Executor) -> None:
    """With the uniforms of Shadertoy, and 8 bits of a mask in place of its blue noise."""
    text = (
        "#version 300 es\nprecision highp float;\nuniform vec3 iResolution;\nuniform float iTime;\n"
        f"uniform sampler2D iChannel0;\n{(SNIPPETS / 'shadertoy.glsl').read_text()}\nout vec4 o_colour;\n"
        "void main() {\n mainImage(o_colour, gl_FragCoord.xy);\n}\n"
    )
    words = quantised(load_mask("vac-1.5").ranks, 8).astype(np.uint8).tobytes()

    def picture(samples: int) -> Picture:
        mask = executor._context.texture((SIDE, SIDE), 1, words)
        mask.build_mipmaps()
        uniforms = {"iResolution": (WIDTH * samples, HEIGHT * samples, 1.0), "iTime": 3.0, "iChannel0": 0}
        return render(executor, text, mask, uniforms, samples)

    truth = picture(SAMPLES)
    assert truth.std() > 0.1
    found = error(picture(1), truth)
    assert found < 16.0, found


def test_the_saturation_has_no_pole(probe: Probe) -> None:
    """README's saturation is that of the snippet: 1 behind a crest, nothing before it, finite where 1 / tan is not."""
    lines = re.findall(r"float (?:theta|saturation) = .*;", (SNIPPETS / "shadertoy.glsl").read_text())
    readme = (SNIPPETS.parents[1] / "README.md").read_text().replace("\n", " ")
    for line in lines:
        quoted = line.partition(" = ")[2].removesuffix(";").removeprefix("clamp(exp").removesuffix(", 0.0, 1.0)")
        assert quoted in readme
    turns = np.float32([0.0, 1.0, -1.0, 7.0, 1e5])[:, None]
    phases = np.concatenate([turns * np.float32(2.0 * math.pi) + at for at in np.float32([-0.05, 0.0, 0.05])])
    before, at, behind = probe([], f"float phase = x.x; {' '.join(lines)} y.x = saturation;", phases)[:, 0].reshape(
        3, -1
    )
    for values in (before, at, behind):
        assert np.isfinite(values).all()
        assert ((values >= 0.0) & (values <= 1.0)).all()
    assert (before[:4] < 1e-6).all()
    assert (behind[:4] == 1.0).all()
