#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""occlude_depth.py [OUTPUT.npy]: a depth map in, its occlusion out."""
import sys

import numpy

# snippet: depth
import glssao

depth = glssao.render(output="depth", size=(640, 360), fov=45)  # or glssao.read_depth("scan.exr"), or your own array
projection = glssao.perspective(45, 640, 360)
accessibility = glssao.occlusion(depth, projection, radius=0.5)  # 1 open, 0 occluded
# end

numpy.save(sys.argv[1] if len(sys.argv) > 1 else "accessibility.npy", accessibility)
print(f"{glssao.device()}: {accessibility.mean():.3f} of the light of the surroundings arrives")
