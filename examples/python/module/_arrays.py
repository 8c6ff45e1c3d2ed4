# SPDX-License-Identifier: MIT
"""Occlusion of depth maps: arrays in, an array out. Each thread that asks gets an OpenGL context of its own."""
from __future__ import annotations

import ctypes
import os
import threading
import weakref
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _layout
from ._library import Error, library, refuse_rest, settings_from
from ._projection import column_major

Floats = NDArray[np.float32]
_of_thread = threading.local()


def _call(function: Any, *arguments: Any) -> Any:
    """Calls a function that returns something false and fills its last two parameters, a line of text, when it fails."""
    line = ctypes.create_string_buffer(1024)
    result = function(*arguments, line, len(line))
    if not result:
        raise Error(line.value.decode(errors="replace"))
    return result


class _Session:
    """An OpenGL context and the thread that it lives on; closed when the Python thread that opened it ends."""

    def __init__(self) -> None:
        self.handle = _call(library.occlude_create, 0)
        weakref.finalize(self, library.occlude_destroy, self.handle)


def _session() -> Any:
    if not hasattr(_of_thread, "session"):
        _of_thread.session = _Session()
    return _of_thread.session.handle


def _pointer(array: Floats) -> Any:
    return array.ctypes.data_as(ctypes.POINTER(ctypes.c_float))


def _unmask(values: Any, dtype: Any) -> Any:
    """Masked values become NaN, which is no surface."""
    return values.astype(dtype).filled(np.nan) if hasattr(values, "filled") else values


def _map(values: ArrayLike, name: str, channels: int = 1) -> Floats:
    """A packed array of floats, checked for its type and shape."""
    kind = np.asarray(values).dtype
    if kind.kind not in "biufO":
        raise ValueError(f"{name} holds values of type {kind}: want real numbers")
    with np.errstate(over="ignore"):  # beyond float32: infinite
        array = np.ascontiguousarray(_unmask(values, np.float32), np.float32)
    last = (channels,) if channels > 1 else ()
    if array.ndim != 2 + len(last) or array.shape[2:] != last or array.size == 0:
        wanted = ", ".join(["height", "width", *map(str, last)])
        raise ValueError(f"{name} has the shape {array.shape}: want ({wanted})")
    return array


def occlusion(depth: ArrayLike, projection: ArrayLike, radius: float, normals: ArrayLike | None = None,
              quality: str = "high", *, technique: str = "horizon", window_depth: bool = False,
              clip_zero_to_one: bool = False, solid: bool = False, estimates: int = 0, error: float = 0.0,
              **settings: Any) -> Floats:
    """Accessibility of a depth map.

    depth             (height, width): view distance in scene units. No surface: 0, infinity, NaN or masked.
    projection        4 x 4 clip_from_view for column vectors, or its 16 numbers in columns as OpenGL takes them
    radius            scene units: how far away an occluder can be
    normals           (height, width, 3): view space, any length; None: rebuilt from depth
    quality           "low", "medium", "high" or "ultra"
    technique         "classic", "hemisphere" or "horizon"
    window_depth      depth holds what a depth buffer stores, 0 to 1; no surface: the far end
    clip_zero_to_one  window depth was drawn under glClipControl(..., GL_ZERO_TO_ONE)
    solid             with view distance: occluders reach down without end, as terrain does
    estimates         horizon: the mean of so many full-size estimates, for less noise; 0: one frame
    error             with estimates: enough of them once their sampling error is at most this; 0: all of them
    settings          any other field of glssao_settings: power=2, blur="none"

    Returns (height, width) float32: 1 is open, 0 fully occluded, 1 where there is no surface.
    Raises glssao.Error with the library's line, and ValueError for arrays that do not fit.
    """
    depth = _map(depth, "depth")
    height, width = depth.shape
    given = _layout.occlude_input(
        width=width, height=height, depth=_pointer(depth), projection=(ctypes.c_float * 16)(*column_major(projection)),
        clip_zero_to_one=clip_zero_to_one, window_depth=window_depth, solid=solid, estimates=estimates, error=error)
    if normals is not None:
        normals = _map(normals, "normals", 3)
        if normals.shape[:2] != depth.shape:
            raise ValueError(f"normals are of {normals.shape[1]} x {normals.shape[0]} pixels, depth of {width} x {height}")
        given.normals = _pointer(normals)
    chosen, rest = settings_from(technique, quality, radius, settings)
    refuse_rest(rest, _layout.glssao_settings)
    result = np.empty(depth.shape, np.float32)
    _call(library.occlude_compute, _session(), ctypes.byref(given), ctypes.byref(chosen), _pointer(result))
    return result


def heightmap(heights: ArrayLike, spacing: float, radius: float, quality: str = "high", **options: Any) -> Floats:
    """Accessibility of terrain, seen straight from above.

    heights   (rows, columns): height in scene units; NaN, infinite or masked: a hole
    spacing   scene units between neighbouring heights
    radius    scene units. Beyond the map's edge there is nothing that occludes
    options   as in occlusion

    Returns (rows, columns) float32, as occlusion does.
    """
    exact = np.asarray(_unmask(heights, np.float64), np.float64)
    finite = exact[np.isfinite(exact)]
    relative = _map(exact - (finite.max() if finite.size else 0.0), "heights")  # keeps millimetres at 8000 metres
    depth = np.empty_like(relative)
    projection = (ctypes.c_float * 16)()
    _call(library.occlude_look_down, _pointer(relative), relative.shape[1], relative.shape[0], spacing, _pointer(depth),
          projection)
    return occlusion(depth, list(projection), radius, quality=quality, solid=True, **options)


def _read(function: Any, path: str | os.PathLike[str], *arguments: Any) -> tuple[Floats, int]:
    """An array (height, width, channels) from a file, and the value that stands for 1 in it."""
    held = _layout.map_file()
    if b"\0" in os.fsencode(path):
        raise ValueError("a path can't hold a zero character")
    _call(function, os.fsencode(path), *arguments, ctypes.byref(held))
    try:
        shape = (held.height, held.width, held.channels)
        return np.ctypeslib.as_array(held.values, shape).copy(), held.full
    finally:
        library.map_file_free(ctypes.byref(held))


def read_depth(path: str | os.PathLike[str], scale: float = 1.0) -> Floats:
    """(height, width) float32 from PFM, 16-bit PNG, .npy or, where the library was built with it, OpenEXR.

    scale   scene units for each step of a PNG, for example 0.001 where it holds millimetres
    """
    return _read(library.map_file_read_depth, path, scale)[0][..., 0]


def read_normals(path: str | os.PathLike[str]) -> Floats:
    """(height, width, 3) float32, -1 to 1, from the same formats. A PNG stores 0 to 1 for that."""
    return _read(library.map_file_read_normals, path)[0]


def device() -> str:
    """Which driver computes on this thread, for a person."""
    text: bytes = library.occlude_description(_session())
    return text.decode(errors="replace")
