# SPDX-License-Identifier: MIT
"""glssao beside pyglet: Effect in its context, with its texture objects, and occlusion, which leaves that context current."""
import ctypes
import unittest

from support import Case, need

need(("numpy", "python3-numpy"), ("pyglet", "python3-pyglet"))
import numpy as np
import pyglet

pyglet.options["headless"] = True
try:
    from pyglet import gl
    window = pyglet.window.Window(8, 8, visible=False)
except Exception as error:
    print(f"skipped: pyglet opens no context without a display: {error}")
    raise SystemExit(77)

import glssao

SIZE = width, height = 96, 64
PROJECTION = glssao.perspective(50, width, height)


class Pyglet(Case):
    def test_effect_and_occlusion_agree_in_one_thread(self):
        distance = np.full((height, width), 4.0, "f4")
        distance[:, width // 2:] = 5.0  # every row is the same, so their order does not matter
        texture = pyglet.image.Texture.create(*SIZE)
        gl.glBindTexture(gl.GL_TEXTURE_2D, texture.id)
        gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_R32F, *SIZE, 0, gl.GL_RED, gl.GL_FLOAT, distance.ctypes.data)
        wanted = glssao.occlusion(distance, PROJECTION, 1.5)
        got, bound = np.empty((height, width), "f4"), gl.GLint()
        gl.glGetIntegerv(gl.GL_TEXTURE_BINDING_2D, ctypes.byref(bound))
        self.assertEqual(bound.value, texture.id)  # of this context, which is still current
        with glssao.Effect(*SIZE) as effect:
            gl.glBindTexture(gl.GL_TEXTURE_2D, effect.compute(texture, PROJECTION, 1.5, depth_kind="view_distance"))
            gl.glGetTexImage(gl.GL_TEXTURE_2D, 0, gl.GL_RED, gl.GL_FLOAT, got.ctypes.data)
        self.assertLess(wanted.min(), 0.8)
        np.testing.assert_allclose(got[::-1], wanted, atol=2e-3)


if __name__ == "__main__":
    unittest.main()
