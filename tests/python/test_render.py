# SPDX-License-Identifier: MIT
"""glssao.render: each output, options, and errors that carry the program's message."""
import os
import unittest

from support import Case, need

need(("numpy", "python3-numpy"))
import numpy as np

import glssao

SMALL = {"size": (160, 90)}


class Render(Case):
    def test_outputs_have_their_shapes_and_ranges(self):
        picture = glssao.render(**SMALL)
        self.assertEqual((picture.shape, picture.dtype), ((90, 160, 3), np.uint8))
        self.assertGreater(picture.std(), 10)
        depth = glssao.render(output="depth", scene="plane", **SMALL)
        self.assertEqual((depth.shape, depth.dtype), ((90, 160), np.float32))
        normals = glssao.render(output="normals", **SMALL)
        self.assertLess(np.abs(np.linalg.norm(normals, axis=2) - 1).max(), 0.02)

    def test_occlusion_of_the_depth_is_the_renderers(self):
        view = {"scene": "cornell", "fov": 45, "eye": (0.3, 0.2, 3.5), "target": [0, 0, 0], **SMALL}
        wanted = glssao.render(output="ao", radius=0.5, **view)
        depth = glssao.render(output="depth", **view)
        normals = glssao.render(output="normals", **view)
        got = glssao.occlusion(depth, glssao.perspective(45, 160, 90), 0.5, normals)
        self.assertLess(wanted.min(), 0.8)
        self.assertLess(np.abs(got - wanted).mean(), 2e-3)

    def test_errors_carry_the_programs_line(self):
        with self.assertRaisesRegex(glssao.Error, "^glssao-render: .*missing.gltf"):
            glssao.render("missing.gltf", **SMALL)
        with self.assertRaisesRegex(glssao.Error, "unknown option --colour"):
            glssao.render(colour=1, **SMALL)
        self.assertRefused(ValueError, "output = 'video': want picture, ao, depth, normals", glssao.render, output="video")
        self.assertRefused(ValueError, "with these options glssao-render makes no single picture: frames", glssao.render, frames=2,
                           **SMALL)
        os.environ["GLSSAO_RENDER"] = "/no/such/program"
        try:
            with self.assertRaisesRegex(glssao.Error, "^/no/such/program: No such file or directory"):
                glssao.render(**SMALL)
        finally:
            del os.environ["GLSSAO_RENDER"]


if __name__ == "__main__":
    unittest.main()
