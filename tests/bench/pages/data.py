# SPDX-License-Identifier: MIT
"""Reads the tables of glssao-bench and glssao-economy, and computes what pages say about them."""
import math
import os
import random

RESAMPLES = 2000
# For each measure: its name in a page, whether less is better, and how scenes are put together.
MEASURES = {
    "rmse": ("RMSE", True, "rms"),
    "mean": ("mean", None, "mean"),
    "p99": ("99th percentile", True, "mean"),
    "off_share": ("off by > 0.1", True, "mean"),
    "ssim": ("SSIM", False, "mean"),
    "flip": ("FLIP", True, "mean"),
    "grain": ("grain", True, "rms"),
    "frame_change": ("frame change", True, "rms"),
    "roll_change": ("roll change", True, "rms"),
    "specks": ("specks", True, "sum"),
}


class Missing(Exception):
    """A table that a block needs is not there."""


class Table:
    """The rows of a file as dictionaries; numbers are floats, empty cells None."""

    def __init__(self, path):
        with open(path, encoding="utf-8") as f:
            lines = f.read().splitlines()
        self.command = lines[0].lstrip("# ")
        self.notes = dict(cell.split("=", 1) for cell in lines[1].lstrip("# ").split("\t") if "=" in cell)
        head = 2 if lines[1].startswith("#") else 1
        names = lines[head].split("\t")
        self.rows = [dict(zip(names, map(parse, line.split("\t")))) for line in lines[head + 1 :]]

    def where(self, **wanted):
        return [row for row in self.rows if all(row.get(key) == value for key, value in wanted.items())]

    def values(self, column):
        """Of each row, in the order of the file, without repeats."""
        return list(dict.fromkeys(row[column] for row in self.rows))


def parse(cell):
    if cell == "":
        return None
    try:
        return float(cell)
    except ValueError:
        return cell


def load(folder, name):
    path = os.path.join(folder, name + ".tsv")
    return Table(path) if os.path.exists(path) else None


def is_few_rays(config):
    """Whether a configuration gets a few rays that the host traces: rays-LEVEL, or any -with-N-rays, adaptive or not."""
    name = config.removesuffix("-adaptive")
    return name.endswith("-rays") or (name.startswith("rays-") and not name.split("-")[1].isdigit())


def combine(values, how):
    """One figure over scenes, each of the same weight; None where one is missing."""
    values = list(values)
    if not values or any(value is None for value in values):
        return None
    if how == "sum":
        return sum(values)
    if how == "mean":
        return sum(values) / len(values)
    return math.sqrt(sum(value * value for value in values) / len(values))


def resample(count):
    """The same draws in each run and for each configuration, so that differences are paired."""
    generator = random.Random(1)
    return [[generator.randrange(count) for _ in range(count)] for _ in range(RESAMPLES)]


def interval(statistic, count):
    """95 % bootstrap interval over scenes of statistic(list of scene numbers)."""
    values = sorted(statistic(draw) for draw in resample(count))
    return values[int(0.025 * RESAMPLES)], values[int(0.975 * RESAMPLES) - 1]


class Accuracy:
    """accuracy.tsv beside scenes.tsv: figures of a configuration over all scenes of one use."""

    def __init__(self, folder, use="tuning"):
        self.table, scenes = load(folder, "accuracy"), load(folder, "scenes")
        if not self.table or not scenes:
            raise Missing(folder)
        self.uses = {row["scene"]: row["use"] for row in scenes.rows}
        self.scenes = [scene for scene in self.table.values("scene") if self.uses[scene] == use]
        self.by_config = {}
        for row in self.table.rows:
            self.by_config.setdefault(row["configuration"], {})[row["scene"]] = row

    def configs(self, **wanted):
        firsts = [next(iter(rows.values())) for rows in self.by_config.values()]
        return [row["configuration"] for row in firsts if all(row.get(k) == v for k, v in wanted.items())]

    def has(self, config):
        return config in self.by_config

    def info(self, config):
        return next(iter(self.by_config[config].values()))

    def figures(self, config, column):
        return [self.by_config[config][scene][column] for scene in self.scenes]

    def figure(self, config, column, how=None):
        return combine(self.figures(config, column), how or MEASURES.get(column, (0, 0, "rms"))[2])

    def rmse_interval(self, config):
        values = self.figures(config, "rmse")
        return interval(lambda draw: combine((values[i] for i in draw), "rms"), len(values))

    def change(self, config, base):
        """How much less RMSE a configuration has than another: share, and its interval."""
        a, b = self.figures(config, "rmse"), self.figures(base, "rmse")

        def share(draw):
            below = combine((b[i] for i in draw), "rms")
            return combine((a[i] for i in draw), "rms") / below - 1 if below else 0

        return share(range(len(a))), interval(share, len(a))

    def time(self, config, column="median_ms"):
        """On the scene that times were taken on."""
        rows = self.by_config[config]
        scene = self.table.notes.get("time_scene")
        return rows[scene].get(column) if scene in rows else None

    def front(self, configs, column="rmse"):
        """Configurations that no other one beats in both time and the measure."""
        less = MEASURES[column][1]
        points = [(self.time(c), self.figure(c, column) * (1 if less else -1), c) for c in configs
                  if self.time(c) is not None and self.figure(c, column) is not None]
        points.sort()
        best, front = math.inf, []
        for _, value, config in points:
            if value < best:
                best = value
                front.append(config)
        return front


def geometric_mean(values):
    values = list(values)
    return math.exp(sum(map(math.log, values)) / len(values))
