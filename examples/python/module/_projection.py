# SPDX-License-Identifier: MIT
"""Projection matrices: clip_from_view, 4 x 4, for column vectors. For view distance, near and far don't matter."""
from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

Matrix = NDArray[np.float64]


def _check(**values: float) -> None:
    for name, value in values.items():
        if not (math.isfinite(value) and value > 0):
            raise ValueError(f"{name} = {value}: want a positive number")


def perspective(fov: float, width: float, height: float, near: float = 0.1, far: float = 1000.0) -> Matrix:
    """A camera with a vertical field of view of `fov` degrees and a picture of width x height (any unit)."""
    _check(fov=fov, width=width, height=height)
    if fov >= 180:
        raise ValueError(f"fov = {fov}: want less than 180 degrees")
    focal = 0.5 * height / math.tan(math.radians(fov) / 2.0)
    return pinhole(focal, focal, width / 2.0, height / 2.0, width, height, near, far)


def pinhole(fx: float, fy: float, cx: float, cy: float, width: float, height: float, near: float = 0.1,
            far: float = 1000.0) -> Matrix:
    """A calibrated camera: focal lengths and principal point in pixels, from the picture's upper left corner."""
    _check(fx=fx, fy=fy, width=width, height=height)
    return np.array([[2.0 * fx / width, 0.0, 1.0 - 2.0 * cx / width, 0.0],
                     [0.0, 2.0 * fy / height, 2.0 * cy / height - 1.0, 0.0],
                     [0.0, 0.0, (far + near) / (near - far), 2.0 * far * near / (near - far)],
                     [0.0, 0.0, -1.0, 0.0]])


def orthographic(width: float, height: float, near: float = 0.1, far: float = 1000.0) -> Matrix:
    """A view of width x height scene units without perspective."""
    _check(width=width, height=height)
    return np.array([[2.0 / width, 0.0, 0.0, 0.0],
                     [0.0, 2.0 / height, 0.0, 0.0],
                     [0.0, 0.0, 2.0 / (near - far), (far + near) / (near - far)],
                     [0.0, 0.0, 0.0, 1.0]])


def column_major(projection: Any) -> list[float]:
    """The 16 numbers of a 4 x 4 matrix as OpenGL takes them; 16 numbers are taken as they are."""
    matrix = np.asarray(projection, np.float64)
    if matrix.shape == (4, 4):
        # Libraries for row vectors hold the transpose. It would pass as a camera with another focal length.
        if matrix[2, 3] == -1.0 and matrix[3, 2] != -1.0:
            raise ValueError("projection is transposed: its last row must be 0, 0, -1, 0; pass projection.T")
        matrix = matrix.T
    if matrix.size != 16:
        raise ValueError(f"projection has the shape {matrix.shape}: want 4 x 4, or 16 numbers in columns")
    numbers: list[float] = matrix.ravel().tolist()
    return numbers
