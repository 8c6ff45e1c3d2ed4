# SPDX-License-Identifier: MIT
"""The effect in a program's own OpenGL context: moderngl, PyOpenGL, pyglet, or any other."""
from __future__ import annotations

import ctypes
import logging
from collections.abc import Callable
from typing import Any

from numpy.typing import ArrayLike

from . import _layout
from ._library import Error, choose, fill, library, refuse_rest, settings_from
from ._projection import column_major

_logger = logging.getLogger("glssao")
_levels: dict[int, int] = {_layout.glssao_log_level.ERROR: logging.ERROR, _layout.glssao_log_level.WARNING: logging.WARNING,
                           _layout.glssao_log_level.INFO: logging.INFO}


def _default_load() -> Callable[[str], int]:
    """A loader for contexts of EGL and GLX, whose functions libglvnd shares."""
    for library_name, function_name in (("libEGL.so.1", "eglGetProcAddress"), ("libGL.so.1", "glXGetProcAddressARB")):
        try:
            find = getattr(ctypes.CDLL(library_name), function_name)
        except (OSError, AttributeError):
            continue
        find.restype, find.argtypes = ctypes.c_void_p, [ctypes.c_char_p]
        return lambda name: int(find(name.encode()) or 0)
    raise Error("neither libEGL.so.1 nor libGL.so.1 is there: pass load, which finds an OpenGL function's address by name")


def _name(thing: Any) -> int:
    """The OpenGL name of a number, of moderngl's objects (glo) and of pyglet's (id)."""
    for attribute in ("glo", "id"):
        thing = getattr(thing, attribute, thing)
    return int(getattr(thing, "value", thing) or 0)


class Effect:
    """Ambient occlusion in the OpenGL context that is current on this thread.

    Every method needs that context to be current, and leaves its state as it was. close(), or `with`, deletes what the
    effect made. Warnings and information go to the logger "glssao"; errors are raised.
    """

    def __init__(self, width: int, height: int, load: Callable[[str], int | None] | None = None, **config: Any) -> None:
        """
        width, height   pixels: the size of the depth textures handed over
        load            finds the address of an OpenGL function by its name; None: through EGL or GLX
        config          any other field of glssao_config: seed=1, no_timers=True, path="fragment"
        """
        find = load or _default_load()
        self._effect = ctypes.c_void_p()
        self._errors: list[str] = []
        # ctypes would let go of these while the library still calls them.
        self._callbacks = (_layout.glssao_load_fn(lambda name, user: find(name.decode())),
                           _layout.glssao_log_fn(lambda level, message, user: self._log(level, message)))
        given = _layout.glssao_config(load=self._callbacks[0], log=self._callbacks[1], width=width, height=height)
        if config.get("program_cache") is not None:
            config["program_cache"] = str(config["program_cache"]).encode()
        refuse_rest(fill(given, config), _layout.glssao_config)
        self._check(library.glssao_create(ctypes.byref(given), ctypes.byref(self._effect)))

    def _log(self, level: int, message: bytes) -> None:
        text = message.decode(errors="replace")
        if level == _layout.glssao_log_level.ERROR:
            self._errors.append(text)
        else:
            _logger.log(_levels.get(level, logging.INFO), "%s", text)

    def _check(self, result: int) -> None:
        errors, self._errors = self._errors, []
        if result != _layout.glssao_result.OK:
            raise Error(errors[0] if errors else library.glssao_result_string(result).decode())

    @property
    def _handle(self) -> ctypes.c_void_p:
        if not self._effect:
            raise Error("the effect is closed")
        return self._effect

    def compute(self, depth: Any, projection: ArrayLike, radius: float, normals: Any = 0, quality: str = "high", *,
                technique: str = "horizon", **options: Any) -> int:
        """Computes accessibility and returns the name of the texture that holds it in red.

        depth        texture of the effect's size: an OpenGL name, or an object of moderngl or pyglet
        projection   4 x 4 clip_from_view for column vectors, or its 16 numbers in columns as OpenGL takes them
        radius       scene units: how far away an occluder can be
        normals      texture of view-space normals; 0: rebuilt from depth
        options      any other field of glssao_frame (depth_kind="view_distance") or glssao_settings (power=2)
        """
        frame = _layout.glssao_frame(depth_texture=_name(depth), normal_texture=_name(normals),
                                     projection=(ctypes.c_float * 16)(*column_major(projection)))
        settings, rest = settings_from(technique, quality, radius, options)
        refuse_rest(fill(frame, rest), _layout.glssao_frame, _layout.glssao_settings)
        self._check(library.glssao_compute(self._handle, ctypes.byref(frame), ctypes.byref(settings)))
        return self.map()[0]

    def apply(self, framebuffer: Any = 0, **options: Any) -> None:
        """Multiplies the last result into the colour of a framebuffer: a name, an object, or 0 for the default one.

        options      any other field of glssao_apply_options, such as intensity=0.5 or strength_texture=texture
        """
        given = library.glssao_default_apply_options()
        given.framebuffer = _name(framebuffer)
        textures = {name: _name(value) for name, value in options.items() if name.endswith("_texture")}
        refuse_rest(fill(given, options | textures), _layout.glssao_apply_options)
        self._check(library.glssao_apply_with(self._handle, ctypes.byref(given)))

    def resize(self, width: int, height: int) -> None:
        """Takes depth textures of this size from now on. Textures that map returned are no longer valid."""
        self._check(library.glssao_resize(self._handle, width, height))

    def map(self, name: str = "ambient") -> tuple[int, int, int]:
        """Name, width and height of one of the effect's textures: a member of glssao_map_id, such as "normal"."""
        width, height = ctypes.c_int(), ctypes.c_int()
        texture = library.glssao_map(self._handle, choose(_layout.glssao_map_id, "name", name), ctypes.byref(width),
                                     ctypes.byref(height))
        return texture, width.value, height.value

    def times(self) -> dict[str, float]:
        """Milliseconds of GPU time for each pass of the last frame whose time is known. Never waits."""
        stats = library.glssao_get_stats(self._handle)
        return {one.name.decode(): one.gpu_ms for one in stats.passes if one.name and one.draw_calls and one.gpu_ms >= 0.0}

    def close(self) -> None:
        """Deletes what the effect made. Every later call raises Error."""
        library.glssao_destroy(self._effect)
        self._effect = ctypes.c_void_p()

    def __enter__(self) -> Effect:
        return self

    def __exit__(self, *exception: object) -> None:
        self.close()
