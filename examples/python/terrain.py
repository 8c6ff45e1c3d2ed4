#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""terrain.py [OUTPUT.ppm]: hills seen from above, lit from the north-west; on the right with occlusion in the valleys."""
import sys

import numpy

import glssao

ROWS, COLUMNS, SPACING = 384, 640, 10.0  # metres between heights


def hills(random: numpy.random.Generator) -> numpy.ndarray:
    """Ridges: noise whose power falls with the frequency, folded at its mean."""
    frequency = numpy.hypot(numpy.fft.fftfreq(ROWS)[:, None], numpy.fft.rfftfreq(COLUMNS)[None]) + 0.004
    noise = numpy.fft.irfft2(numpy.fft.rfft2(random.standard_normal((ROWS, COLUMNS))) / frequency**2.8, (ROWS, COLUMNS))
    return 350.0 * (1.0 - numpy.abs(noise / noise.std()))


heights = hills(numpy.random.default_rng(3))
# snippet: terrain
accessibility = glssao.heightmap(heights, spacing=SPACING, radius=500.0, quality="ultra", estimates=16)
# end

south, east = numpy.gradient(heights, SPACING)
light = numpy.clip((east + south + 1.2) / numpy.sqrt(3.5 * (1.0 + east**2 + south**2)), 0.0, 1.0)
ambient = numpy.where(numpy.arange(COLUMNS) < COLUMNS // 2, 1.0, accessibility)
pixels = 255.0 * numpy.clip(0.45 * light + 0.5 * ambient, 0.0, 1.0)
with open(sys.argv[1] if len(sys.argv) > 1 else "terrain.ppm", "wb") as file:
    file.write(b"P6 %d %d 255\n" % (COLUMNS, ROWS) + numpy.repeat(pixels.astype("u1")[..., None], 3, axis=2).tobytes())
