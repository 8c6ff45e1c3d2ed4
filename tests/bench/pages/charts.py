# SPDX-License-Identifier: MIT
"""Draws charts with gnuplot. The colours are told apart by all eyes (Okabe and Ito)."""
import math
import subprocess

import data

COLORS = {"classic": "#d55e00", "hemisphere": "#0072b2", "horizon": "#009e73", "rays": "#555555", "peer": "#cc79a7"}
SHAPES = {"classic": 7, "hemisphere": 5, "horizon": 9, "rays": 6, "peer": 13}
WIDTH, HEIGHT = 1000, 640
LEFT, RIGHT, BOTTOM, TOP = 80, 30, 70, 90  # margins in pixels


def run(script):
    subprocess.run(["gnuplot"], input=script, text=True, check=True)


def head(picture, title, subtitle, x_label, y_label):
    return f"""set terminal pngcairo size {WIDTH},{HEIGHT} font "DejaVu Sans,10" background "#ffffff"
set output "{picture}"
set lmargin at screen {LEFT / WIDTH}
set rmargin at screen {1 - RIGHT / WIDTH}
set bmargin at screen {BOTTOM / HEIGHT}
set tmargin at screen {1 - TOP / HEIGHT}
set label "{title}" at screen 0.5,0.965 center font ",14"
set label "{subtitle}" at screen 0.5,0.92 center font ",9" textcolor rgb "#505050"
set xlabel "{x_label}"
set ylabel "{y_label}"
set grid lc rgb "#e0e0e0"
set border 3 lc rgb "#606060"
set tics nomirror
set key top right samplen 1
"""


def block(name, rows):
    return f"${name} << END\n" + "".join(" ".join(map(str, row)) + "\n" for row in rows) + "END\n"


class Labels:
    """Finds places for labels near their marks, in pixels, so that they cover nothing."""

    def __init__(self, marks):
        self.taken = [(x - 7, y - 7, x + 7, y + 7) for x, y in marks]

    def place(self, x, y, text):
        w, h = 6.6 * len(text), 15
        for ring in range(6):
            reach = 10 + ring * 12
            for dx, dy in ((1, 0), (-1, 0), (0, 1), (0, -1), (1, 1), (1, -1), (-1, 1), (-1, -1)):
                cx = x + dx * (w / 2 + (reach / 2 if dy else reach))
                cy = y + dy * (h / 2 + reach - 4)
                box = (cx - w / 2, cy - h / 2, cx + w / 2, cy + h / 2)
                inside = box[0] > LEFT and box[2] < WIDTH - RIGHT and box[1] > BOTTOM and box[3] < HEIGHT - TOP
                if inside and not any(self.overlap(box, other) for other in self.taken):
                    self.taken.append(box)
                    return cx, cy
        return None

    @staticmethod
    def overlap(a, b):
        return a[0] < b[2] and b[0] < a[2] and a[1] < b[3] and b[1] < a[3]


def technique_of(info):
    return info["technique"]


def short(config, technique):
    return config[len(technique) + 1 :] if config.startswith(technique + "-") else config


def needs_scene(config, info):
    """Whether a host needs more than depth and normals: hidden surfaces, or rays through the scene."""
    return info["inputs"] == "beyond" or technique_of(info) == "rays" or data.is_few_rays(config)


def accuracy(a, column, picture):
    """A measure against time: a mark a configuration, and the front of all that need no more than depth and normals."""
    name, less, _ = data.MEASURES[column]
    configs = [c for c in a.by_config if a.time(c) is not None and a.figure(c, column) is not None]
    if not configs:
        return False
    # Some peers and few rays are so far off that the levels would lie on a line.
    limit = 1.25 * max((a.figure(c, column) for c in configs if a.info(c)["level"] and a.info(c)["technique"] not in ("peer", "rays")),
                       default=math.inf)
    beyond = [c for c in configs if less and a.figure(c, column) > limit]
    configs = [c for c in configs if c not in beyond]
    points = {c: (a.time(c), a.figure(c, column)) for c in configs}
    x = [math.log10(p[0]) for p in points.values()]
    y = [p[1] for p in points.values()]
    margin = 0.06 * (max(x) - min(x)) + 0.02
    x_low, x_high = min(x) - margin, max(x) + margin * 2
    y_low, y_high = min(y) - 0.08 * (max(y) - min(y)), max(y) + 0.06 * (max(y) - min(y))

    def pixel(point):
        return (LEFT + (math.log10(point[0]) - x_low) / (x_high - x_low) * (WIDTH - LEFT - RIGHT),
                BOTTOM + (point[1] - y_low) / (y_high - y_low) * (HEIGHT - BOTTOM - TOP))

    notes = a.table.notes
    direction = "lower" if less else "higher"
    script = head(picture, f"{name} of ambient occlusion against time",
                  f"{len(a.scenes)} scenes at {notes['size']}; truth: {notes['rays']} rays a pixel; {direction} is better; "
                  "contrast techniques have their best exponent" + (f"; {len(beyond)} worse marks are off the chart" if beyond else ""),
                  f"milliseconds a frame at {notes['time_size']} (log)", name)
    script += f"set logscale x\nset xrange [{10**x_low}:{10**x_high}]\nset yrange [{y_low}:{y_high}]\n"
    if not less: # slow and good marks are at the top right
        script += "set key bottom right\n"
    plain = [c for c in configs if not needs_scene(c, a.info(c))]
    front = a.front(plain, column)
    script += block("front", [points[c] for c in front])
    plots = ['$front with lines lw 2 lc rgb "#a0a0a0" title "Pareto front of depth and normals"']
    for technique in dict.fromkeys(technique_of(a.info(c)) for c in configs):
        own = [c for c in configs if technique_of(a.info(c)) == technique]
        script += block(technique, [points[c] for c in own])
        plots.append(f'${technique} with points pt {SHAPES[technique]} ps 1.2 lc rgb "{COLORS[technique]}" '
                     f'title "{technique}"')
    labels = Labels(map(pixel, points.values()))
    for config in sorted(configs, key=lambda c: (not a.info(c)["level"], c not in front)):
        info = a.info(config)
        if not info["level"] and config not in front and not data.is_few_rays(config):
            continue
        at, text = pixel(points[config]), short(config, technique_of(info))
        place = labels.place(*at, text)
        if place:
            color = COLORS[technique_of(info)]
            script += (f'set label "{text}" at screen {place[0] / WIDTH},{place[1] / HEIGHT} center front font ",9" '
                       f'textcolor rgb "{color}" noenhanced\n')
    run(script + "plot " + ", ".join(plots) + "\n")
    return True


def lines(picture, title, subtitle, x_label, y_label, series, log=False):
    """series: {name: [(x, y), ...]}."""
    palette = ["#009e73", "#0072b2", "#d55e00", "#cc79a7", "#e69f00", "#56b4e9", "#000000", "#999999"]
    script = head(picture, title, subtitle, x_label, y_label)
    x = [point[0] for points in series.values() for point in points]
    script += f"set logscale xy\nset xrange [{0.9 * min(x)}:{1.1 * max(x)}]\n" if log else "set yrange [0:*]\n"
    script += "set key top left\n"
    plots = []
    for i, (name, points) in enumerate(series.items()):
        script += block(f"s{i}", points)
        plots.append(f'$s{i} with linespoints lw 2 pt 7 ps 0.8 lc rgb "{palette[i % len(palette)]}" title "{name}" noenhanced')
    run(script + "plot " + ", ".join(plots) + "\n")


def bars(picture, title, subtitle, y_label, names, series):
    """Clustered bars: series {name: [y, ...]}, one cluster a name."""
    palette = ["#d55e00", "#0072b2"]
    script = head(picture, title, subtitle, "", y_label)
    script += ("set style data histograms\nset style fill solid 0.9\nset boxwidth 0.9\nset yrange [0:*]\n"
               "set style histogram clustered gap 1\nset xtics rotate by -20\nset key top left\n")
    rows = [[f'"{name}"'] + [values[i] for values in series.values()] for i, name in enumerate(names)]
    script += block("d", rows)
    plots = [f'$d using {i + 2}:xtic(1) lc rgb "{palette[i]}" title "{name}"' for i, name in enumerate(series)]
    run(script + "plot " + ", ".join(plots) + "\n")
