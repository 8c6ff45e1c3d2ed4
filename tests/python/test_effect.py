# SPDX-License-Identifier: MIT
"""glssao.Effect in a context of moderngl's, with its textures and with PyOpenGL's."""
import os
import unittest

from support import Case, need

need(("numpy", "python3-numpy"), ("moderngl", "python3-moderngl"))
os.environ["PYOPENGL_PLATFORM"] = "egl"
import moderngl
import numpy as np

import glssao

SIZE = width, height = 96, 64
PROJECTION = glssao.perspective(50, width, height)


def step_depth():
    """Window depth of a wall at 4 whose right half stands at 5; rows from the bottom are the same."""
    depth = np.full((height, width), 4.0)
    depth[:, width // 2:] = 5.0
    return (0.5 + 0.5 * (PROJECTION[2, 3] / depth - PROJECTION[2, 2])).astype("f4")


class Effect(Case):
    @classmethod
    def setUpClass(cls):
        cls.context = moderngl.create_context(standalone=True, backend="egl")

    def tearDown(self):
        self.assertEqual(self.context.error, "GL_NO_ERROR")

    def read(self, texture):
        """A texture of the effect's, rows from the top."""
        context = self.context
        # snippet: read
        result = context.external_texture(texture, (width, height), components=1, samples=0, dtype="f4")
        accessibility = np.frombuffer(result.read(), "f4").reshape(height, width)  # row 0 is the bottom
        # end
        return accessibility[::-1]

    def test_result_is_that_of_occlusion(self):
        window = step_depth()
        wanted = glssao.occlusion(window, PROJECTION, 1.5, window_depth=True, quality="ultra")
        texture = self.context.depth_texture(SIZE, window[::-1].tobytes())
        with glssao.Effect(*SIZE) as effect:
            for depth in (texture, texture.glo):
                got = self.read(effect.compute(depth, PROJECTION, 1.5, quality="ultra"))
                np.testing.assert_allclose(got, wanted, atol=2 / 65535)
            self.assertEqual(effect.map(), (effect.map()[0], width, height))
            self.assertEqual(effect.map("normal")[1:], SIZE)
        self.assertLess(wanted.min(), 0.8)

    def test_apply_darkens_a_framebuffer(self):
        texture = self.context.depth_texture(SIZE, step_depth().tobytes())
        color = self.context.texture(SIZE, 4)
        framebuffer = self.context.framebuffer(color)
        framebuffer.clear(1.0, 1.0, 1.0, 1.0)
        with glssao.Effect(*SIZE) as effect:
            result = self.read(effect.compute(texture, PROJECTION, 1.5))[::-1]
            effect.apply(framebuffer)
        got = np.frombuffer(color.read(), np.uint8).reshape(height, width, 4)
        self.assertLess(np.abs(got[..., 0] / 255 - result).max(), 0.003)
        self.assertTrue((got[..., 3] == 255).all())

    def test_apply_takes_options(self):
        texture = self.context.depth_texture(SIZE, step_depth().tobytes())
        color = self.context.texture(SIZE, 4, dtype="f4")
        framebuffer = self.context.framebuffer(color)
        strength = np.linspace(0.0, 1.0, width * height, dtype="f4").reshape(height, width)
        weights = self.context.texture(SIZE, 1, strength.tobytes(), dtype="f4")
        framebuffer.clear(1.0, 1.0, 1.0, 1.0)
        with glssao.Effect(*SIZE) as effect:
            result = self.read(effect.compute(texture, PROJECTION, 1.5))[::-1]
            effect.apply(framebuffer, intensity=0.5, color=(0.0, 0.25, 1.0), strength_texture=weights)
            with self.assertRaisesRegex(glssao.Error, "options.intensity = 2"):
                effect.apply(framebuffer, intensity=2)
            with self.assertRaises(TypeError):
                effect.apply(framebuffer, strenght_texture=weights)
        got = np.frombuffer(color.read(), "f4").reshape(height, width, 4)
        gone = (0.5 * strength * (1.0 - result))[..., None]
        np.testing.assert_allclose(got[..., :3], 1.0 - gone + gone * np.array([0.0, 0.25, 1.0]), atol=1e-5)

    def test_frame_fields_are_options(self):
        distance = np.full((height, width), 4.0, "f4")
        distance[:, width // 2:] = 5.0
        wanted = glssao.occlusion(distance, PROJECTION, 1.5)
        texture = self.context.texture(SIZE, 1, distance.tobytes(), dtype="f4")
        with glssao.Effect(*SIZE, seed=0, path="fragment") as effect:
            got = self.read(effect.compute(texture, PROJECTION, 1.5, depth_kind="view_distance", viewport=(0, 0, *SIZE)))
        np.testing.assert_allclose(got, wanted, atol=2e-3)

    def test_times_are_those_of_the_passes_that_ran(self):
        texture = self.context.depth_texture(SIZE, step_depth().tobytes())
        with glssao.Effect(*SIZE) as effect:
            self.assertEqual(effect.times(), {})
            effect.compute(texture, PROJECTION, 1.5)
            self.context.finish()
            times = effect.times()
            self.assertGreater(times["estimate"], 0.0)
            self.assertNotIn("apply", times)
        with glssao.Effect(*SIZE, no_timers=True) as effect:
            effect.compute(texture, PROJECTION, 1.5)
            self.context.finish()
            self.assertEqual(effect.times(), {})

    def test_errors_are_the_librarys_lines(self):
        texture = self.context.depth_texture((8, 8))
        with self.assertRaisesRegex(glssao.Error, "want 1 to"):
            glssao.Effect(0, 5)
        with self.assertRaisesRegex(TypeError, "^unknown: colour; known: .*seed"):
            glssao.Effect(4, 4, colour=1)
        effect = glssao.Effect(*SIZE)
        self.assertRefused(glssao.Error, "frame.depth_texture = 0: no texture", effect.compute, 0, PROJECTION, 1)
        with self.assertRaisesRegex(glssao.Error, f"^frame.depth_texture = {texture.glo}: .*the full size, 96 x 64"):
            effect.compute(texture, PROJECTION, 1)
        effect.resize(8, 8)
        effect.compute(texture, PROJECTION, 1)
        self.assertRefused(ValueError, "name = 'colour': want ambient, ambient_other, normal, random_vector, depth, tiles, rebuilt_normal, " +
                           "bent_normal",
                           effect.map, "colour")
        effect.close()
        effect.close()
        self.assertRefused(glssao.Error, "the effect is closed", effect.compute, texture, PROJECTION, 1)

    def test_names_of_other_libraries_are_taken(self):
        class Pyglet:
            id = 7
        import ctypes

        from glssao._effect import _name
        self.assertEqual([_name(thing) for thing in (7, np.uint32(7), ctypes.c_uint(7), Pyglet(), None)], [7, 7, 7, 7, 0])

    def test_pyopengl_shares_the_context(self):
        try:
            from OpenGL import GL
        except ImportError:
            self.skipTest("no OpenGL (Debian and Ubuntu: apt install python3-opengl)")
        texture = GL.glGenTextures(1)
        GL.glBindTexture(GL.GL_TEXTURE_2D, texture)
        GL.glTexImage2D(GL.GL_TEXTURE_2D, 0, GL.GL_DEPTH_COMPONENT24, *SIZE, 0, GL.GL_DEPTH_COMPONENT, GL.GL_FLOAT, step_depth())
        with glssao.Effect(*SIZE) as effect:
            result = effect.compute(texture, PROJECTION, 1.5)
            self.assertEqual(GL.glGetIntegerv(GL.GL_TEXTURE_BINDING_2D), texture)  # left as it was
            GL.glBindTexture(GL.GL_TEXTURE_2D, result)
            got = GL.glGetTexImage(GL.GL_TEXTURE_2D, 0, GL.GL_RED, GL.GL_FLOAT)
        self.assertLess(got.min(), 0.8)
        self.assertGreater(got.max(), 0.99)


if __name__ == "__main__":
    unittest.main()
