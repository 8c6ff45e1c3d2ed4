# SPDX-License-Identifier: MIT
"""The figures that pages compute, on tables made up for the purpose, and the filling of a page."""
import math
import os
import subprocess
import sys
import tempfile
import unittest

import blocks
import charts
import data

HERE = os.path.dirname(os.path.abspath(__file__))
NOTES = "# made up\n# time_scene=a\tsize=8x8\ttime_size=8x8\trays=1\tsoftware=1\tglssao=0\tcpu=x\tcores=1\tcontext=y\n"


def write(folder, name, columns, rows):
    with open(os.path.join(folder, name + ".tsv"), "w", encoding="utf-8") as f:
        f.write(NOTES + "\t".join(columns) + "\n")
        f.writelines("\t".join(map(str, row)) + "\n" for row in rows)


def make(folder, rmse, ms):
    """rmse: {configuration: [a value a scene]}; ms: {configuration: time on the first scene}."""
    columns = ["configuration", "technique", "level", "inputs", "scene", "rmse", "ssim", "specks", "median_ms"]
    rows = [[c, "peer" if c == "other" else "horizon", 1, "normals", "abcdefgh"[i], value, 1 - value, i, ms[c] if i == 0 else ""]
            for c, values in rmse.items() for i, value in enumerate(values)]
    write(folder, "accuracy", columns, rows)
    count = len(next(iter(rmse.values())))
    write(folder, "scenes", ["scene", "use"], [["abcdefgh"[i], "tuning"] for i in range(count)])
    return data.Accuracy(folder)


class Figures(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.folder = self.temporary.name
        self.addCleanup(self.temporary.cleanup)

    def test_motion_compares_with_ultra(self):
        columns = ["scene", "motion", "setting", "rmse", "ssim", "flip", "frame_change", "new_rmse", "lag", "cpu_ms"]
        rows = [["a", m, s, r, 0.5, 0.1, 2 * r, 3 * r, 4, 100 * r]
                for m in ("orbit", "cut", "box") for s, r in (("low", 0.3), ("low-16", 0.15), ("ultra", 0.1))]
        rows += [["b", "pan", s, 0.1, 0.5, 0.1, 0.1, 0.1, 0, 10] for s in ("low", "low-16", "ultra")]
        write(self.folder, "motion", columns, rows)
        lines = blocks.motion(self.folder).split("\n")
        rms = math.sqrt((0.15**2 + 0.1**2) / 2)
        self.assertIn(f"| `low-16` | {rms:.4f} ({rms / 0.1:.2f}) | 0.500 | 0.100 |", lines[3])
        self.assertIn("| 4 | 12.5 (1.25) |", lines[3])
        self.assertIn("|  | 20.0 (2.00) |", lines[2])
        self.assertEqual(len(lines), 5)

    def test_scenes_count_the_same(self):
        a = make(self.folder, {"horizon-low": [0.3, 0.4]}, {"horizon-low": 1})
        self.assertAlmostEqual(a.figure("horizon-low", "rmse"), math.sqrt((0.09 + 0.16) / 2))
        self.assertAlmostEqual(a.figure("horizon-low", "ssim"), 0.65)
        self.assertEqual(a.figure("horizon-low", "specks"), 1)

    def test_scenes_of_equal_error_have_no_interval(self):
        a = make(self.folder, {"horizon-low": [0.1] * 8}, {"horizon-low": 1})
        low, high = a.rmse_interval("horizon-low")
        self.assertAlmostEqual(low, 0.1)
        self.assertAlmostEqual(high, 0.1)

    def test_interval_of_a_mean_is_as_wide_as_its_standard_error(self):
        values = [i / 7 for i in range(8)]
        low, high = data.interval(lambda draw: sum(values[i] for i in draw) / 8, 8)
        mean = sum(values) / 8
        error = math.sqrt(sum((v - mean) ** 2 for v in values) / 8 / 8)
        self.assertAlmostEqual(low, mean - 1.96 * error, delta=0.2 * error)
        self.assertAlmostEqual(high, mean + 1.96 * error, delta=0.2 * error)

    def test_differences_are_paired(self):
        scenes = [0.01, 0.4, 0.05, 0.2, 0.3, 0.02, 0.1, 0.15]
        a = make(self.folder, {"horizon-low": scenes, "horizon-high": [0.9 * s for s in scenes]}, {"horizon-low": 1, "horizon-high": 2})
        share, (low, high) = a.change("horizon-high", "horizon-low")
        self.assertAlmostEqual(share, -0.1)
        self.assertAlmostEqual(low, -0.1)
        self.assertAlmostEqual(high, -0.1)

    def test_front_is_of_what_depth_and_normals_give(self):
        plain = {"inputs": "normals", "technique": "horizon"}
        self.assertFalse(charts.needs_scene("horizon-high", plain))
        self.assertTrue(charts.needs_scene("horizon-high-with-2-rays", plain))
        self.assertTrue(charts.needs_scene("horizon-high-with-2-rays-adaptive", plain))
        self.assertFalse(charts.needs_scene("horizon-high", plain))
        self.assertTrue(charts.needs_scene("horizon-high-beyond", {**plain, "inputs": "beyond"}))
        self.assertTrue(charts.needs_scene("rays-low", {**plain, "technique": "rays"}))

    def test_front_has_what_is_not_beaten_in_both(self):
        rmse = {"horizon-low": [0.3], "horizon-medium": [0.2], "horizon-high": [0.25], "horizon-ultra": [0.1]}
        ms = {"horizon-low": 1, "horizon-medium": 2, "horizon-high": 3, "horizon-ultra": 4}
        a = make(self.folder, rmse, ms)
        self.assertEqual(a.front(list(rmse)), ["horizon-low", "horizon-medium", "horizon-ultra"])
        self.assertEqual(a.front(list(rmse), "ssim"), ["horizon-low", "horizon-medium", "horizon-ultra"])

    def test_peers_that_beat_a_level_are_listed(self):
        a = make(self.folder, {"horizon-low": [0.1, 0.4], "other": [0.2, 0.3]}, {"horizon-low": 5, "other": 4})
        rows = [row[2:4] for row in blocks.beaten_rows(a)]
        self.assertEqual(rows, [("rmse", "b"), ("ssim", "b"), ("median_ms", "a")])

    def test_rays_stand_beside_their_denoised_picture(self):
        columns = ["configuration", "technique", "scene", "rmse", "ssim", "flip", "grain", "median_ms"]
        rows = [["rays-2", "rays", "a", 0.2, 0.5, 0.1, 0.01, 3], ["rays-2-denoised", "rays", "a", 0.1, 0.6, 0.05, 0, 4],
                ["rays-4", "rays", "a", 0.1, 0.7, 0.1, 0.01, 5], ["rays-low", "rays", "a", 0.1, 0.5, 0.1, 0.01, 3]]
        write(self.folder, "accuracy", columns, rows)
        write(self.folder, "scenes", ["scene", "use"], [["a", "tuning"]])
        lines = blocks.rays(self.folder).split("\n")
        self.assertEqual(lines[2], "| 2 | 3.00 | 0.2000 | 0.500 | 0.100 | 0.0100 | 4.00 | 0.1000 | 0.600 | 0.050 | 0.0000 |")
        self.assertTrue(lines[3].startswith("| 4 | 5.00 |") and lines[3].endswith("|  |  |  |  |  |"))
        self.assertEqual(len(lines), 4)

    def test_blocks_are_filled_and_others_kept(self):
        docs, machine = os.path.join(self.folder, "docs"), os.path.join(self.folder, "data", "here")
        os.makedirs(docs)
        os.makedirs(machine)
        write(machine, "economy-first", ["kept", "ms"], [["nothing", 12.34]])
        page = os.path.join(docs, "page.md")
        with open(page, "w", encoding="utf-8") as f:
            f.write("Before\n<!-- economy_first here -->\nold\n<!-- end -->\n<!-- levels there -->\nkept\n<!-- end -->\nAfter\n")
        subprocess.run([sys.executable, os.path.join(HERE, "make.py"), os.path.join(self.folder, "data"), docs], check=True,
                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        with open(page, encoding="utf-8") as f:
            text = f.read()
        self.assertIn("| nothing | 12.3 |", text)
        self.assertNotIn("old", text)
        self.assertTrue(text.endswith("<!-- levels there -->\nkept\n<!-- end -->\nAfter\n"))


if __name__ == "__main__":
    unittest.main()
