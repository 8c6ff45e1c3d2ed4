// SPDX-License-Identifier: MIT
// Members of the uniform block cbHemisphere (std140), the hemisphere technique's own. Read by both compilers.
vec4 gKernel[64];           // xyz in the hemisphere about +z, length 0.1..1, nearest first
vec4 gRotations[16];        // xy: unit vectors, one a pixel of the 4x4 tile
