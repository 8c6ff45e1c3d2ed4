# SPDX-License-Identifier: MIT
"""make.py DATA DOCS: fills the blocks of every page in DOCS from the tables in DATA, and draws their charts.

A block lies between two comments, for instance
    <!-- levels llvmpipe -->
    <!-- end -->
The first word is a function of blocks.py or of this file, the second a folder in DATA; more words are its arguments. A
block whose data is missing stays as it is, with a message.
"""
import os
import re
import sys

sys.dont_write_bytecode = True

import blocks
import charts
from data import MEASURES, Accuracy, Missing, load

BLOCK = re.compile(r"<!-- ([a-z_]+) ([^>]*?)-->\n.*?<!-- end -->", re.S)


def picture(docs, name, alt):
    os.makedirs(os.path.join(docs, "pictures"), exist_ok=True)
    return os.path.join(docs, "pictures", name), f"![{alt}](pictures/{name})"


def chart(docs, folder, column):
    name, machine = MEASURES[column][0], os.path.basename(folder)
    parts = ["accuracy", column.replace("_", "-") if column != "rmse" else "", machine if machine != "llvmpipe" else ""]
    path, link = picture(docs, "-".join(filter(None, parts)) + ".png", f"{name} against time on {machine}")
    return link if charts.accuracy(Accuracy(folder), column, path) else None


def economy_steps(docs, folder):
    t = load(folder, "economy-steps")
    if not t:
        return None
    path, link = picture(docs, f"economy-steps-{os.path.basename(folder)}.png", "Time of a frame as effects are added")
    charts.bars(path, "A frame as effects are added", f"scene {t.notes['time_scene']} at {t.notes['time_size']}, one effect more from left to right",
                "milliseconds a frame", [r["effect"] for r in t.rows],
                {"every pixel": [r["every_ms"] for r in t.rows], "as planned": [r["planned_ms"] for r in t.rows]})
    return link


def economy_shares(docs, folder):
    t = load(folder, "economy-shares")
    if not t:
        return None
    path, link = picture(docs, f"economy-shares-{os.path.basename(folder)}.png", "Time of occlusion as sky or flat area grows")
    series = {f"{kind}, {name}": [(100 * r["share"], r[column]) for r in t.where(kind=kind)]
              for kind in t.values("kind") for name, column in (("every pixel", "every_ms"), ("tiles skipped", "skipping_ms"))}
    charts.lines(path, "Occlusion as sky or flat area grows", f"horizon-high on a rough wall at {t.notes['time_size']}",
                 "share of the picture that is sky or a plane (%)", "milliseconds a frame", series)
    return link


def sweep(docs, folder, kind):
    """Cost over the picture's size or the radius."""
    t = load(folder, "sweep")
    if not t:
        return None
    label = {"size": "megapixels", "radius": "radius in parts of the scene's own"}[kind]
    path, link = picture(docs, f"cost-{kind}-{os.path.basename(folder)}.png", f"Time against {kind}")
    series = {f"{c}{', depth alone' if i == 'depth' else ''}": [(r["value"], r["ms"]) for r in t.where(kind=kind, configuration=c, inputs=i)]
              for c in t.values("configuration") for i in t.values("inputs")}
    charts.lines(path, f"Cost as the {kind} grows", f"scene {t.notes['time_scene']}", label, "milliseconds a frame",
                 {name: points for name, points in series.items() if points}, log=True)
    return link


CHARTS = {f.__name__: f for f in (chart, economy_steps, economy_shares, sweep)}


def fill(match, data_folder, docs, page):
    name, arguments = match.group(1), match.group(2).split()
    folder = os.path.join(data_folder, arguments[0]) if arguments else data_folder
    try:
        if name in CHARTS:
            text = CHARTS[name](docs, folder, *arguments[1:])
        else:
            text = getattr(blocks, name)(folder, *arguments[1:])
    except Missing:
        text = None
    except (AttributeError, KeyError, FileNotFoundError, StopIteration) as fault:
        sys.exit(f"make.py: {page}: block {match.group(1)} {match.group(2)}: {type(fault).__name__}: {fault}")
    if text is None:
        print(f"make.py: {page}: block {match.group(1)} {match.group(2)}keeps its content: no data", file=sys.stderr)
        return match.group(0)
    return f"<!-- {match.group(1)} {match.group(2)}-->\n{text}\n<!-- end -->"


def write_beaten(data_folder):
    for name in sorted(os.listdir(data_folder)):
        folder = os.path.join(data_folder, name)
        if not load(folder, "accuracy"):
            continue
        a = Accuracy(folder)
        if not a.configs(technique="peer"):
            continue
        with open(os.path.join(folder, "beaten.tsv"), "w", encoding="utf-8") as f:
            f.write("# tests/bench/pages/make.py: where a peer is better than a level, from accuracy.tsv\n")
            f.write("peer\tlevel\tmeasure\tscene\tpeer_value\tlevel_value\n")
            for peer, level, column, scene, theirs, ours in blocks.beaten_rows(a):
                f.write(f"{peer}\t{level}\t{column}\t{scene}\t{theirs:.6g}\t{ours:.6g}\n")


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    data_folder, docs = sys.argv[1:]
    write_beaten(data_folder)
    for page in sorted(os.listdir(docs)):
        if not page.endswith(".md"):
            continue
        path = os.path.join(docs, page)
        with open(path, encoding="utf-8") as f:
            text = f.read()
        filled = BLOCK.sub(lambda match: fill(match, data_folder, docs, page), text)
        if filled != text:
            with open(path, "w", encoding="utf-8") as f:
                f.write(filled)
            print(f"{page} is filled")


if __name__ == "__main__":
    main()
