# SPDX-License-Identifier: MIT
"""Pictures of glTF scenes, drawn by glssao-render in a process of its own."""
from __future__ import annotations

import os
import subprocess
import tempfile
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import _paths
from ._arrays import _read
from ._library import Error, library

_outputs = {"picture": ("--output", "png"), "ao": ("--ao", "pfm"), "depth": ("--depth", "pfm"), "normals": ("--normals", "png")}


def _words(name: str, value: Any) -> list[str]:
    """One option of glssao-render: fov=45, eye=(1, 2, 3), no_shadows=True."""
    flag = "--" + name.replace("_", "-")
    if value is None or value is False:
        return []
    if value is True:
        return [flag]
    if isinstance(value, (str, bytes, os.PathLike)):
        return [flag, os.fsdecode(value)]
    if np.ndim(value) > 0:
        return [flag, ",".join(format(part, ".9g") for part in value)]
    return [flag, format(value, ".9g") if isinstance(value, float) else str(value)]


def render(path: str | os.PathLike[str] | None = None, output: str = "picture", size: tuple[int, int] = (1280, 720),
           **options: Any) -> NDArray[Any]:
    """A glTF scene, or with path None a built-in one, drawn by glssao-render.

    output    "picture": (height, width, 3) uint8, sRGB
              "ao":      (height, width) float32, accessibility
              "depth":   (height, width) float32, view distance in scene units, 0 where nothing is
              "normals": (height, width, 3) float32, view space
    size      width and height in pixels
    options   glssao-render's, with _ for -: technique="raytrace", eye=(0, 1, 5), fov=45, no_shadows=True

    Raises glssao.Error with the program's message.
    """
    if output not in _outputs:
        raise ValueError(f"output = {output!r}: want {', '.join(_outputs)}")
    flag, ending = _outputs[output]
    program = os.environ.get("GLSSAO_RENDER") or os.path.join(os.path.dirname(__file__), _paths.RENDER)
    with tempfile.TemporaryDirectory(prefix="glssao-") as folder:
        file = os.path.join(folder, "result." + ending)
        command = [program, flag, file, "--size", "x".join(map(str, size))]
        for name, value in options.items():
            command += _words(name, value)
        if path is not None:
            command.append(os.path.abspath(os.fsdecode(path)))  # never taken for an option
        try:
            done = subprocess.run(command, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
        except OSError as error:
            raise Error(f"{program}: {error.strerror} (the environment variable GLSSAO_RENDER names another)") from None
        if done.returncode != 0:
            lines = done.stderr.decode(errors="replace").splitlines() or [f"{program} ended with code {done.returncode}"]
            raise Error(next((line for line in lines if line.startswith("glssao-render: ")), lines[-1]))
        if not os.path.exists(file):
            raise ValueError(f"with these options glssao-render makes no single picture: {', '.join(options)}")
        if output == "normals":
            return _read(library.map_file_read_normals, file)[0]
        values = _read(library.map_file_read, file)[0]
    return values.astype(np.uint8) if output == "picture" else values[..., 0]
