#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""moderngl_effect.py [OUTPUT.ppm]: cubes on a floor, drawn by moderngl without a window, darkened by the effect."""
import sys

import moderngl
import numpy

import glssao

SIZE = width, height = 960, 540
CUBE = numpy.array([[(face, a, b), (face, b, a)][face < 0] for face in (-1, 1)
                    for a, b in ((-1, -1), (1, -1), (1, 1), (-1, -1), (1, 1), (-1, 1))], "f4")
CUBE = numpy.concatenate([numpy.roll(CUBE, axis, axis=1) for axis in range(3)])  # 12 triangles, seen from outside
VERTEX = """#version 330
uniform mat4 clip_from_view;
in vec3 corner, center, half_size;
out vec3 position_view;
void main()
{
    position_view = center + half_size * corner;
    gl_Position = clip_from_view * vec4(position_view, 1.0);
}"""
FRAGMENT = """#version 330
in vec3 position_view;
out vec4 color;
void main()
{
    vec3 normal_view = normalize(cross(dFdx(position_view), dFdy(position_view)));
    color = vec4(vec3(0.75 + 0.25 * dot(normal_view, normalize(vec3(1.0, 2.0, 1.5)))), 1.0);
}"""

context = moderngl.create_context(standalone=True, backend="egl")
projection = glssao.pinhole(600.0, 600.0, width / 2, 60.0, width, height, near=0.1, far=50.0)  # the horizon lies at row 60
depth = context.depth_texture(SIZE)
color = context.texture(SIZE, 4)
framebuffer = context.framebuffer(color, depth)
program = context.program(vertex_shader=VERTEX, fragment_shader=FRAGMENT)
program["clip_from_view"].write(projection.T.astype("f4").tobytes())
random = numpy.random.default_rng(1)
cubes = [(x + 0.3 * random.random(), -2.4, z, 0.3, 0.3 * (1 + 2 * random.random()), 0.3)
         for x in range(-3, 4) for z in range(-9, -3)] + [(0.0, -2.8, -8.0, 20.0, 0.1, 12.0)]
geometry = context.vertex_array(program, [(context.buffer(CUBE.tobytes()), "3f", "corner"),
                                          (context.buffer(numpy.array(cubes, "f4").tobytes()), "3f 3f/i", "center", "half_size")])


def draw() -> None:
    framebuffer.use()
    framebuffer.clear(0.8, 0.85, 0.9)
    context.enable(moderngl.DEPTH_TEST)
    geometry.render(instances=len(cubes))


# snippet: effect
with glssao.Effect(width, height) as effect:
    draw()  # into `framebuffer`, whose depth is the texture `depth`
    effect.compute(depth, projection, radius=0.6)
    effect.apply(framebuffer)
# end

pixels = numpy.frombuffer(framebuffer.read(components=3, alignment=1), numpy.uint8).reshape(height, width, 3)
with open(sys.argv[1] if len(sys.argv) > 1 else "moderngl_effect.ppm", "wb") as file:
    file.write(b"P6 %d %d 255\n" % SIZE + pixels[::-1].tobytes())
