# SPDX-License-Identifier: MIT
"""The example programs run, and what they write shows occlusion."""
import importlib.util
import os
import subprocess
import sys
import tempfile
import unittest

from support import Case, need

need(("numpy", "python3-numpy"))
import numpy as np

FOLDER = os.path.join(os.path.dirname(__file__), "../../examples/python")


def run(script, ending):
    """The bytes that the script writes into the file it is told."""
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "output" + ending)
        subprocess.run([sys.executable, os.path.join(FOLDER, script), path], check=True, stdout=subprocess.DEVNULL)
        return np.load(path) if ending == ".npy" else read_ppm(path)


def read_ppm(path):
    with open(path, "rb") as file:
        width, height = map(int, file.readline()[3:].split()[:2])
        return np.frombuffer(file.read(), np.uint8).reshape(height, width, 3).astype(int)


class Examples(Case):
    def test_readme(self):
        with open(os.path.join(FOLDER, "../../README.md"), encoding="utf-8") as file:
            code = file.read().split("```python\n")[1].split("```")[0]
        names = {}
        exec(code, names)
        self.assertEqual(names["accessibility"].shape, (360, 640))
        self.assertLess(names["accessibility"].min(), 0.5)

    def test_occlude_depth(self):
        accessibility = run("occlude_depth.py", ".npy")
        self.assertEqual(accessibility.shape, (360, 640))
        self.assertLess(accessibility.min(), 0.5)

    def test_terrain(self):
        picture = run("terrain.py", ".ppm")[..., 0]
        plain, shaded = np.hsplit(picture, 2)
        self.assertEqual(plain.min(), 127)  # ambient light alone
        self.assertLess(shaded.min(), 60)
        self.assertLess(shaded.mean(), plain.mean() - 20)

    @unittest.skipIf(importlib.util.find_spec("moderngl") is None, "no moderngl (Debian and Ubuntu: apt install python3-moderngl)")
    def test_moderngl_effect(self):
        picture = run("moderngl_effect.py", ".ppm")
        self.assertEqual(picture.shape, (540, 960, 3))
        self.assertTrue((picture[:60] == [204, 217, 230]).all())  # the sky stays
        self.assertGreater((picture.sum(axis=2) < 200).mean(), 0.005)  # between cubes it is dark


if __name__ == "__main__":
    unittest.main()
