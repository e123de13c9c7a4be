"""Creates and checks the GL context of a process, and sets it to the initial state of OpenGL ES."""

import ctypes
from typing import Any

import moderngl

from seafoam.extras import UnableError

_ES3 = "GL_ARB_ES3_compatibility"
_REMEDY = (
    "install Mesa's software renderer (Debian, Ubuntu: apt-get install libegl1 libgl1 "
    "libgl1-mesa-dri), or use a GPU driver with EGL"
)


_FRAMEBUFFER, _COLOR_ATTACHMENT0 = 0x8D40, 0x8CE0
"""GL_FRAMEBUFFER and GL_COLOR_ATTACHMENT0."""


class NoRendererError(UnableError):
    """OpenGL is not usable on this machine. The message says what failed and what to install."""


def create_context(device_index: int | None = None) -> moderngl.Context:
    """Create a headless EGL context that compiles ``#version 300 es``.

    ``device_index``: EGL device, ``None`` for the driver's default. Raises :class:`NoRendererError`.
    Desktop GL compiles ES 3.00 source through GL_ARB_ES3_compatibility (core since 4.3), so the same source runs here
    and in WebGL2.
    """
    settings: dict[str, Any] = {"backend": "egl", "libgl": "libGL.so.1", "libegl": "libEGL.so.1"}
    if device_index is not None:
        settings["device_index"] = device_index
    try:
        context = moderngl.create_context(standalone=True, require=330, **settings)
    except Exception as error:  # moderngl raises plain Exception for every failure of the driver
        raise NoRendererError(f"no OpenGL context: {error}; {_REMEDY}") from error
    if context.version_code < 430 and _ES3 not in context.extensions:
        name = context.info["GL_RENDERER"]
        context.release()
        raise NoRendererError(f"{name} has OpenGL {context.version_code / 100:.1f} without {_ES3}; {_REMEDY}")
    context.enable_only(moderngl.PROGRAM_POINT_SIZE)
    return context


def attach_layers(context: moderngl.Context, framebuffer: moderngl.Framebuffer, array: moderngl.TextureArray) -> None:
    """Attach each layer of ``array`` to a framebuffer of as many attachments, in their place: moderngl cannot."""
    address = context.mglo._context.load_opengl_function("glFramebufferTextureLayer")
    attach = ctypes.CFUNCTYPE(None, *(ctypes.c_uint,) * 3, *(ctypes.c_int,) * 2)(address)
    framebuffer.use()
    for layer in range(array.layers):
        attach(_FRAMEBUFFER, _COLOR_ATTACHMENT0 + layer, array.glo, 0, layer)
