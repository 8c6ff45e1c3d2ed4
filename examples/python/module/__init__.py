# SPDX-License-Identifier: MIT
"""Screen-space ambient occlusion.

occlusion     arrays in, an array out: a depth map becomes accessibility, without a window
heightmap     the same for terrain
render        a glTF scene becomes a picture, through glssao-render
Effect        the library itself, for a program that has an OpenGL context of its own

Accessibility is 1 where a point is open and 0 where it is fully occluded. Arrays hold pictures as NumPy libraries do: row 0
is the top. View space has the camera at its origin, x right, y up, and looks down -z; view distance is -z.
"""
from ._arrays import device, heightmap, occlusion, read_depth, read_normals
from ._effect import Effect
from ._library import Error, __version__
from ._projection import orthographic, perspective, pinhole
from ._render import render

__all__ = ["Effect", "Error", "__version__", "device", "heightmap", "occlusion", "orthographic", "perspective", "pinhole",
           "read_depth", "read_normals", "render"]
