# SPDX-License-Identifier: MIT
"""Arrays in, an array out: known answers, files, threads, forked processes, and what wrong input raises."""
import os
import shutil
import subprocess
import sys
import tempfile
import threading
import unittest

from support import Case, need

need(("numpy", "python3-numpy"))
import numpy as np

import glssao

SIZE = width, height = 96, 64
PROJECTION = glssao.perspective(50, width, height)


def corner_depth():
    """View distance of a floor at y = -1.5 and a wall at z = -6."""
    rows, columns = np.mgrid[0:height, 0:width]
    y = (1 - 2 * (rows + 0.5) / height) / PROJECTION[1, 1]  # of the ray at view distance 1
    with np.errstate(divide="ignore"):
        return np.where(y < 0, np.minimum(-1.5 / y, 6.0), 6.0)


def in_process(work):
    """What work() returns, a text, in a forked child that exits without cleaning up."""
    reader, writer = os.pipe()
    child = os.fork()
    if child == 0:
        try:
            text = work()
        except BaseException as error:
            text = repr(error)
        os.write(writer, text.encode())
        os._exit(0)
    os.close(writer)
    with os.fdopen(reader) as pipe:
        text = pipe.read()
    os.waitpid(child, 0)
    return text


class Occlusion(Case):
    def test_corner_is_dark_along_its_edge_alone(self):
        for quality in ("low", "medium", "high", "ultra"):
            result = glssao.occlusion(corner_depth(), PROJECTION, 1.0, quality=quality)
            self.assertEqual((result.shape, result.dtype), ((height, width), np.float32))
            middle = result[:, width // 2]
            edge = int(np.argmin(middle))  # the floor meets the wall in the lower half, because row 0 is the top
            self.assertGreater(edge, height // 2)
            self.assertLess(middle[edge], 0.8)
            self.assertGreater(middle[:height // 3].min(), 0.995)
            self.assertGreater(middle[-4:].min(), 0.995)

    def test_near_and_far_do_not_matter_for_view_distance(self):
        other = glssao.perspective(50, width, height, near=7.0, far=8.0)
        first, second = (glssao.occlusion(corner_depth(), projection, 1.0) for projection in (PROJECTION, other))
        self.assertLess(np.abs(first - second).max(), 1e-3)

    def test_window_depth_and_normals_say_the_same(self):
        depth = corner_depth()
        clip = PROJECTION @ np.stack([0 * depth, 0 * depth, -depth, 1 + 0 * depth], axis=1)
        window = 0.5 + 0.5 * clip[:, 2] / clip[:, 3]
        normals = np.where((depth < 6.0)[..., None], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0])
        wanted = glssao.occlusion(depth, PROJECTION, 1.0, normals)
        got = glssao.occlusion(window, PROJECTION, 1.0, normals, window_depth=True)
        self.assertLess(np.abs(got - wanted).mean(), 2e-3)
        self.assertLess(np.abs(wanted - glssao.occlusion(depth, PROJECTION, 1.0)).mean(), 5e-3)

    def test_arrays_of_any_kind_are_taken(self):
        depth = np.round(corner_depth())
        wanted = glssao.occlusion(depth, PROJECTION, 1.0)
        masked = np.ma.masked_array(np.where(depth == 6, -1, depth), depth == 6)
        for given in (depth.astype("i2"), depth.astype(">f4"), np.asfortranarray(depth), depth.tolist(),
                      np.repeat(depth, 2, axis=1)[:, ::2]):
            np.testing.assert_array_equal(glssao.occlusion(given, PROJECTION, 1.0), wanted)
        self.assertEqual(glssao.occlusion(masked, PROJECTION, 1.0)[0, 0], 1.0)
        in_columns = PROJECTION.T.ravel()
        np.testing.assert_array_equal(glssao.occlusion(depth, in_columns, 1.0), wanted)

    def test_settings_reach_the_library(self):
        depth = corner_depth()
        plain = glssao.occlusion(depth, PROJECTION, 1.0, technique="classic", blur="none", half_resolution=False, power=1)
        power = glssao.occlusion(depth, PROJECTION, 1.0, technique="classic", blur="none", half_resolution=False, power=2)
        self.assertLess(plain.min(), 0.9)
        self.assertLess(np.abs(plain ** 2 - power).max(), 1e-3)

    def test_principal_point_shifts_the_picture(self):
        focal = 0.5 * height * PROJECTION[1, 1]
        wide = glssao.occlusion(corner_depth(), PROJECTION, 1.0, quality="ultra", estimates=64)
        cut = glssao.pinhole(focal, focal, width / 2 - 16, height / 2, width - 16, height)
        part = glssao.occlusion(corner_depth()[:, 16:], cut, 1.0, quality="ultra", estimates=64)
        self.assertLess(np.abs(part - wide[:, 16:])[:, 16:-16].max(), 0.02)

    def test_wrong_input_raises_one_line(self):
        depth = corner_depth()
        bad = depth.copy()
        bad[5, 3] = -2
        for kind, line, arguments, options in [
            (glssao.Error, "settings.radius = -1: want 0 to 1e+12", (depth, PROJECTION, -1), {}),
            (glssao.Error, "depth[5, 3] = -2: view distance is positive; no surface is 0, infinity or NaN", (bad, PROJECTION, 1),
             {}),
            (glssao.Error, "depth[0, 0] = 6: window depth is 0 to 1", (depth, PROJECTION, 1), {"window_depth": True}),
            (glssao.Error, "frame.projection[0] = nan: not finite", (depth, np.full((4, 4), np.nan), 1), {}),
            (ValueError, "depth has the shape (64,): want (height, width)", (depth[:, 0], PROJECTION, 1), {}),
            (ValueError, "depth has the shape (0, 96): want (height, width)", (depth[:0], PROJECTION, 1), {}),
            (ValueError, "normals has the shape (64, 96): want (height, width, 3)", (depth, PROJECTION, 1, depth), {}),
            (ValueError, "normals are of 2 x 2 pixels, depth of 96 x 64", (depth, PROJECTION, 1, np.ones((2, 2, 3))), {}),
            (ValueError, "projection has the shape (3, 3): want 4 x 4, or 16 numbers in columns", (depth, np.eye(3), 1), {}),
            (ValueError, "projection is transposed: its last row must be 0, 0, -1, 0; pass projection.T",
             (depth, PROJECTION.T, 1), {}),
            (ValueError, "quality = 'best': want low, medium, high, ultra", (depth, PROJECTION, 1), {"quality": "best"}),
            (ValueError, "quality = 3: want low, medium, high, ultra", (depth, PROJECTION, 1), {"quality": 3}),
            (ValueError, "depth holds values of type complex128: want real numbers", (depth + 1j, PROJECTION, 1), {}),
            (ValueError, "depth holds values of type datetime64[s]: want real numbers", (depth.astype("M8[s]"), PROJECTION, 1),
             {}),
            (ValueError, "normals holds values of type <U1: want real numbers", (depth, PROJECTION, 1, [[["x"] * 3]]), {}),
            (ValueError, "blur = 'soft': want none, gaussian, bilateral, box, planar", (depth, PROJECTION, 1),
             {"blur": "soft"}),
        ]:
            with self.subTest(line):
                self.assertRefused(kind, line, glssao.occlusion, *arguments, **options)
        with self.assertRaisesRegex(TypeError, "unknown: powr; known: .*power, radius"):
            glssao.occlusion(depth, PROJECTION, 1, powr=2)
        for line, function, arguments in [
            ("fov = 0: want a positive number", glssao.perspective, (0, 4, 3)),
            ("fov = 180: want less than 180 degrees", glssao.perspective, (180, 4, 3)),
            ("fov = nan: want a positive number", glssao.perspective, (float("nan"), 4, 3)),
            ("height = 0: want a positive number", glssao.perspective, (45, 4, 0)),
            ("fx = -1: want a positive number", glssao.pinhole, (-1, 1, 2, 2, 4, 4)),
            ("width = inf: want a positive number", glssao.orthographic, (float("inf"), 1)),
        ]:
            with self.subTest(line):
                self.assertRefused(ValueError, line, function, *arguments)


class Heightmap(Case):
    def test_foot_of_a_cliff_is_half_dark(self):
        heights = np.zeros((64, 96))
        heights[:, :48] = 6.0
        heights += 8848.0
        result = glssao.heightmap(heights, 0.5, 6.0, quality="ultra", estimates=32)
        self.assertAlmostEqual(result[32, 48], 0.53, delta=0.03)
        self.assertGreater(result[32, :46].min(), 0.99)
        self.assertGreater(result[32, 62:].min(), 0.99)

    def test_heights_are_taken_exactly(self):
        steps = np.zeros((32, 32))
        steps[:, :16] = 0.0004  # float32 holds half millimetres at this height
        near, far = (glssao.heightmap(steps + offset, 0.0001, 0.0008, quality="ultra") for offset in (0.0, 8848.0))
        self.assertLess(near.min(), 0.8)
        self.assertLess(np.abs(near - far).max(), 1e-3)

    def test_wrong_input_raises_one_line(self):
        self.assertRefused(glssao.Error, "no height is a finite number", glssao.heightmap, np.full((4, 4), np.nan), 1, 1)
        self.assertRefused(glssao.Error, "spacing = 0: want a positive number", glssao.heightmap, np.ones((4, 4)), 0, 1)


class Files(Case):
    def test_npy_is_read_and_refused_as_numpy_writes_it(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "depth.npy")
            for dtype in ("<f2", "<f4", ">f8", "u1", "<u2", ">i4", "<u8"):
                for order in ("C", "F"):
                    wanted = np.array([[1, 2, 3], [4, 5, 6]], dtype, order=order)
                    np.save(path, wanted)
                    np.testing.assert_array_equal(glssao.read_depth(path), wanted)
            np.testing.assert_array_equal(glssao.read_depth(path, scale=0.5), wanted / 2)
            normals = np.linspace(-1, 1, 18).reshape(2, 3, 3).astype("f4")
            np.save(path, normals)
            np.testing.assert_array_equal(glssao.read_normals(path), normals)
            self.assertRefused(glssao.Error, f"{path}: 3 channels, where depth has one", glssao.read_depth, path)
            np.save(path, np.array([["text"]]))
            self.assertRefused(glssao.Error, f"{path}: numbers of a type that is neither float nor integer",
                               glssao.read_depth, path)
            self.assertRefused(ValueError, "a path can't hold a zero character", glssao.read_depth, path + "\0.npy")
            self.assertRefused(glssao.Error, f"{folder}/none: No such file or directory", glssao.read_depth, f"{folder}/none")


    def test_a_decimal_comma_changes_nothing(self):
        with tempfile.TemporaryDirectory() as folder:
            made = subprocess.run(["localedef", "-i", "de_DE", "-f", "UTF-8", folder + "/de_DE.UTF-8"], capture_output=True) \
                if shutil.which("localedef") else None
            if not made or made.returncode > 1:  # 1: with warnings
                self.skipTest("no localedef, or no source of a locale with a decimal comma")
            path = os.path.join(folder, "depth.pfm")
            with open(path, "wb") as file:
                file.write(b"Pf\n2 1\n-1.0\n" + np.array([1.5, 2.5], "<f4").tobytes())
            script = ("import locale, glssao; assert locale.setlocale(locale.LC_ALL, 'de_DE.UTF-8');"
                      "assert locale.str(1.5) == '1,5'; depth = glssao.read_depth(r'%s'); assert depth.tolist() == [[1.5, 2.5]];"
                      "glssao.occlusion(depth, glssao.perspective(45, 2, 1), 0.5, power=1.5)" % path)
            subprocess.run([sys.executable, "-c", script], check=True, env={**os.environ, "LOCPATH": folder})


class Threads(Case):
    def test_threads_run_side_by_side_and_give_their_contexts_back(self):
        depth = corner_depth()
        wanted = glssao.occlusion(depth, PROJECTION, 1.0)
        results = [None] * 4

        def work(i):
            for _ in range(3):
                results[i] = glssao.occlusion(depth, PROJECTION, 1.0)

        before = len(os.listdir("/proc/self/task"))
        threads = [threading.Thread(target=work, args=(i,)) for i in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for result in results:
            np.testing.assert_array_equal(result, wanted)
        del thread, threads
        self.assertLess(len(os.listdir("/proc/self/task")), before + 4)

    def test_forked_child_is_refused_and_does_not_hang(self):
        glssao.occlusion(corner_depth(), PROJECTION, 1.0)
        text = in_process(lambda: str(glssao.occlusion(corner_depth(), PROJECTION, 1.0).min()))
        self.assertIn("OpenGL was opened before this process was forked", text)


if __name__ == "__main__":
    unittest.main()
