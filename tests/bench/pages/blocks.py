# SPDX-License-Identifier: MIT
"""The blocks of a page that figures fill: each function returns Markdown, or None where its data is not there."""
import data
from data import MEASURES, Accuracy, combine, geometric_mean, load

LEVELS = ["low", "medium", "high", "ultra"]
TECHNIQUES = ["horizon", "classic", "hemisphere"]
# Levels that a page shows; the data has all.
SHOWN = [f"horizon-{level}" for level in LEVELS] + ["classic-high", "classic-ultra", "hemisphere-low", "hemisphere-high"]


def number(value, digits=4, sign=False):
    if value is None:
        return ""
    return f"{value:{'+' if sign else ''}.{digits}f}"


def ms(value):
    if value is None:
        return ""
    return f"{value:.{3 if value < 1 else 2 if value < 10 else 1 if value < 100 else 0}f}"


def percent(value, digits=0):
    return "" if value is None else f"{100 * value:.{digits}f} %"


def table(head, rows, right=1):
    """All columns from number `right` on are aligned to the right."""
    marks = ["---"] * right + ["---:"] * (len(head) - right)
    return "\n".join("| " + " | ".join(cells) + " |" for cells in [head, marks] + rows)


def machine(folder, name="accuracy"):
    t = load(folder, name)
    if not t:
        return None
    kind = "software rasteriser" if t.notes["software"] == "1" else "GPU"
    return (f"Made by `{t.command}` with glssao {t.notes['glssao']} on {t.notes['cpu']}, {t.notes['cores']} cores; "
            f"{t.notes['context']} ({kind}).")


def level_names(a, count=len(SHOWN)):
    return [c for c in SHOWN[: int(count)] if a.has(c)]


def levels(folder, use="tuning", count=len(SHOWN)):
    """The quality levels: time and every measure, with the interval of the RMSE."""
    a = Accuracy(folder, use)
    if not a.scenes:
        return None
    head = ["level", "ms", "ms, depth alone", "RMSE (95 % interval)", "99th percentile", "off by > 0.1", "SSIM", "FLIP",
            "grain", "frame change", "specks"]
    rows = []
    for c in level_names(a, count):
        low, high = a.rmse_interval(c)
        depth = c + "-depth"
        rows.append([f"`{c}`", ms(a.time(c)), ms(a.time(depth)) if a.has(depth) else "",
                     f"{number(a.figure(c, 'rmse'))} ({number(low, 3)} to {number(high, 3)})", number(a.figure(c, "p99"), 2),
                     percent(a.figure(c, "off_share"), 1), number(a.figure(c, "ssim"), 3), number(a.figure(c, "flip"), 3),
                     number(a.figure(c, "grain")), number(a.figure(c, "frame_change")), f"{a.figure(c, 'specks'):.0f}"])
    return table(head, rows)


def differences(folder):
    """Whether the scenes support that one level is nearer to the truth than another."""
    a = Accuracy(folder)
    pairs = [("horizon-medium", "horizon-low"), ("horizon-high", "horizon-medium"), ("horizon-ultra", "horizon-high"),
             ("horizon-low", "classic-high"), ("horizon-low", "hemisphere-high"), ("horizon-high-beyond", "horizon-high")]
    rows = []
    for c, base in pairs:
        if not a.has(c) or not a.has(base):
            continue
        share, (low, high) = a.change(c, base)
        verdict = "yes" if low > 0 or high < 0 else "no"
        rows.append([f"`{c}` against `{base}`", f"{100 * share:+.1f} %", f"{100 * low:+.1f} to {100 * high:+.1f} %", verdict])
    return table(["levels", "RMSE", "95 % interval", "supported"], rows)


def depth(folder):
    """Depth alone beside depth with normals, against both truths."""
    a = Accuracy(folder)
    rows = []
    for c in level_names(a, 5):
        d = c + "-depth"
        if not a.has(d):
            continue
        ratio = a.time(d) / a.time(c) if a.time(c) and a.time(d) else None
        rows.append([f"`{c}`", ms(a.time(c)), ms(a.time(d)), number(ratio, 2), number(a.figure(c, "rmse")),
                     number(a.figure(d, "rmse")), number(a.figure(d, "flat_rmse", "rms"))])
    return table(["level", "ms", "ms, depth alone", "ratio", "RMSE", "depth alone", "depth alone, flat truth"], rows)


def plain_rays(a):
    """Ray tracing as it comes: rays-N, without rays-N-denoised."""
    return [c for c in a.configs(technique="rays") if c.removeprefix("rays-").isdigit()]


def traced(folder, use="tuning"):
    """A few rays alone and as corrections, beside screen space; where times are known, also plain ray tracing."""
    a = Accuracy(folder, use)
    few = [c for c in a.by_config if data.is_few_rays(c)]
    beside = [f"horizon-{level}" for level in LEVELS if a.has(f"horizon-{level}")]
    if not few:
        return None
    base = a.time("horizon-high", "cpu_ms") if a.has("horizon-high") else None
    timed = any(a.time(c, "cpu_ms") for c in few)
    plain = plain_rays(a) if timed else []
    order = sorted(few + beside + plain, key=lambda c: (a.time(c, "cpu_ms") or 0, -a.figure(c, "rmse")))
    rows = []
    for c in order:
        time = a.time(c, "cpu_ms")
        times = [ms(time), number(time / base if time and base else None, 2)] if timed else []
        rows.append([f"`{c}`", *times, number(a.figure(c, "rmse")), number(a.figure(c, "rmse", "mean")),
                     number(a.figure(c, "ssim"), 3), number(a.figure(c, "grain"))])
    times = ["CPU ms", "of `horizon-high`'s"] if timed else []
    return table(["configuration", *times, "RMSE", "mean of the scenes' RMSE", "SSIM", "grain"], rows)


def bent(folder, use="tuning"):
    """Bent normals of each level, in degrees off the traced mean open direction; each scene counts the same."""
    t, scenes = load(folder, "bent"), load(folder, "scenes")
    if not t or not scenes:
        return None
    uses = {row["scene"]: row["use"] for row in scenes.rows}
    rows = []
    for c in t.values("configuration"):
        cells = [f"`{c}`"]
        for inputs in ("normals", "depth"):
            own = [r for r in t.where(configuration=c, inputs=inputs) if uses.get(r["scene"]) == use]
            for column in ("mean", "occluded_mean", "p95"):
                values = [r[column] for r in own if r[column] is not None]
                cells.append(number(combine(values, "mean"), 1))
        rows.append(cells)
    head = ["configuration"] + [f"{text}{inputs}" for inputs in ("", ", depth alone")
                                for text in ("mean", "where occluded", "95th percentile")]
    return table(head, rows)


def bent_light(folder):
    """RMSE of pictures lit by accessibility alone and by bent normals."""
    t = load(folder, "bent-light")
    if not t:
        return None
    columns = ["matte", "matte_bent", "glossy", "glossy_lobe", "glossy_bent"]
    rows = [[f"`{c}`"] + [number(combine((r[column] for r in t.where(configuration=c)), "rms")) for column in columns]
            for c in t.values("configuration")]
    return table(["configuration", "matte, accessibility", "matte, bent normals", "glossy, accessibility",
                  "glossy, specular occlusion", "glossy, bent normals"], rows)


def rays(folder):
    a = Accuracy(folder)
    rows = []
    kinds = ["", "-denoised"] if any(c.endswith("-denoised") for c in a.by_config) else [""]
    for plain in plain_rays(a):
        row = [plain.removeprefix("rays-")]
        for c in (plain + kind for kind in kinds):
            row += [ms(a.time(c)), number(a.figure(c, "rmse")), number(a.figure(c, "ssim"), 3), number(a.figure(c, "flip"), 3),
                    number(a.figure(c, "grain"))] if a.has(c) else 5 * [""]
        rows.append(row)
    measures = ["RMSE", "SSIM", "FLIP", "grain"]
    head = ["rays a pixel", "ms (CPU)", *measures] + (["denoised: ms", *measures] if len(kinds) > 1 else [])
    return table(head, rows, 0) if rows else None


def peers(folder):
    a = Accuracy(folder)
    rows = []
    for c in a.configs(technique="peer"):
        rows.append([f"`{c}`", ms(a.time(c)), number(a.info(c)["exponent"], 2), number(a.figure(c, "rmse")),
                     number(a.figure(c, "default_rmse", "rms")), number(a.figure(c, "p99"), 2), number(a.figure(c, "ssim"), 3),
                     number(a.figure(c, "flip"), 3), number(a.figure(c, "grain")), number(a.figure(c, "frame_change")),
                     f"{a.figure(c, 'specks'):.0f}"])
    head = ["peer", "ms", "exponent", "RMSE with it", "RMSE as it comes", "99th percentile", "SSIM", "FLIP", "grain",
            "frame change", "specks"]
    return table(head, rows) if rows else None


def beaten_rows(a):
    """Where a peer is better than a level of horizon: peer, level, measure, scene, both figures."""
    for peer in a.configs(technique="peer"):
        for level in [f"horizon-{level}" for level in LEVELS if a.has(f"horizon-{level}")]:
            for column, (name, less, _) in MEASURES.items():
                for scene in a.by_config[peer] if less is not None else []:
                    ours, theirs = (a.by_config[c][scene].get(column) for c in (level, peer))
                    if ours is None or theirs is None:
                        continue
                    if (theirs < ours) if less else (theirs > ours):
                        yield peer, level, column, scene, theirs, ours
            times = a.time(peer), a.time(level)
            if None not in times and times[0] < times[1]:
                yield peer, level, "median_ms", a.table.notes["time_scene"], times[0], times[1]


def beaten(folder, level="high"):
    """On how many scenes each peer is better than a level of horizon; the list is in beaten.tsv."""
    a = Accuracy(folder)
    own = f"horizon-{level}"
    columns = [c for c, m in MEASURES.items() if m[1] is not None and a.info(own).get(c) is not None]
    rows = [row for row in beaten_rows(a) if row[1] == own]
    out = []
    for peer in a.configs(technique="peer"):
        counts = [sum(row[0] == peer and row[2] == c for row in rows) for c in columns]
        faster = any(row[0] == peer and row[2] == "median_ms" for row in rows)
        out.append([f"`{peer}`"] + [str(count) for count in counts] + ["yes" if faster else "no"])
    head = [f"peer, of {len(a.by_config[own])} scenes"] + [MEASURES[c][0] for c in columns] + ["faster"]
    return table(head, out) if out else None


def blur(folder):
    """Each blur at its best number of rounds."""
    a = Accuracy(folder)
    rows = []
    for technique in TECHNIQUES:
        base = f"{technique}-high"
        own = [c for c in a.by_config if a.info(c)["technique"] == technique and a.info(c)["inputs"] == "normals"
               and (c == base or c.startswith(base + "-")) and a.info(c)["size"] == a.info(base)["size"]]
        own = [c for c in own if c == base or c.split("-")[2] in ("noblur", "gaussian", "bilateral", "box", "planar")]
        for kind in ("none", "gaussian", "bilateral", "box", "planar"):
            of_kind = [c for c in own if a.info(c)["blur"] == kind]
            if not of_kind:
                continue
            best = min(of_kind, key=lambda c: a.figure(c, "rmse"))
            rows.append([technique, kind, f"{a.info(best)['rounds']:.0f}", number(a.figure(best, "rmse")),
                         number(a.figure(best, "smooth_rmse", "rms")), number(a.figure(best, "edge_rmse", "rms")),
                         number(a.figure(best, "grain")), ms(a.time(best))])
    return table(["technique", "blur", "rounds", "RMSE", "away from edges", "near edges", "grain", "ms"], rows, 2)


def split(folder):
    t, a = load(folder, "split"), Accuracy(folder)
    if not t:
        return None
    names = {"layer": "one depth layer", "estimator": "the estimator, converged", "half size": "half size",
             "noise": "noise of one frame", "denoising": "after the blur", "contrast": "the default power"}
    configs = [c for c in t.values("configuration") if c.startswith("horizon") or c.endswith("high")]
    rows = []
    for step in t.values("step"):
        cells = [names[step]]
        for c in configs:
            own = [row for row in t.where(configuration=c, step=step) if row["scene"] in a.scenes]
            cells.append(number(combine((row["alone"] for row in own), "rms")))
            cells.append(number(combine((row["total"] for row in own), "rms")))
        rows.append(cells)
    head = ["step"] + [text for c in configs for text in (f"`{c}` alone", "so far")]
    return table(head, rows)


def scenes(folder, count="5"):
    """The scenes with the largest error of horizon-high."""
    a, t = Accuracy(folder), load(folder, "scenes")
    level = "horizon-high"
    worst = sorted(a.scenes, key=lambda s: -a.by_config[level][s]["rmse"])[: int(count)]
    rows = []
    for scene in worst:
        s = t.where(scene=scene)[0]
        rows.append([scene, f"{s['triangles']:.0f}", percent(s["edge_share"])]
                    + [number(a.by_config[c][scene]["rmse"], 3) for c in ("horizon-high", "horizon-ultra", "classic-high",
                                                                           "hemisphere-high") if a.has(c)])
    return table(["scene", "triangles", "near edges", "horizon-high", "horizon-ultra", "classic-high", "hemisphere-high"], rows)


def host(folder):
    """What a host pays for a level."""
    t = load(folder, "host")
    if not t:
        return None
    rows = [[f"`{r['configuration']}`", r["inputs"], ms(r["compute_ms"]), ms(r["apply_ms"]), ms(r["first_ms"]), number(r["mib"], 1)]
            for r in t.rows]
    return table(["level", "inputs", "compute, ms", "apply, ms", "first frame, ms", "maps, MiB"], rows, 2)


def economy_frames(folder):
    t = load(folder, "economy-frames")
    if not t:
        return None
    ratio = geometric_mean(r["planned_ms"] / r["everything_ms"] for r in t.rows)
    first = geometric_mean(r["planned_first_ms"] / r["everything_first_ms"] for r in t.rows)
    rows = [[r["scene"], ms(r["everything_ms"]), ms(r["planned_ms"]), number(r["planned_ms"] / r["everything_ms"], 2),
             percent(r["skipped_share"]), f"{r['everything_draws']:.0f}, {r['planned_draws']:.0f}"]
            for r in sorted(t.rows, key=lambda r: r["planned_ms"] / r["everything_ms"])]
    shown = rows[:5] + rows[-5:] if len(rows) > 10 else rows
    return (table(["scene", "everything, ms", "planned, ms", "ratio", "pixels skipped", "draws"], shown)
            + f"\n\nThe five scenes that save most and the five that save least, of {len(rows)}. Geometric mean of the ratio: "
            f"{ratio:.2f}; of the first frame's: {first:.2f}.")


def economy_tiles(folder):
    t = load(folder, "economy-tiles")
    if not t:
        return None
    rows = []
    for c in t.values("configuration"):
        own = t.where(configuration=c)
        ratios = [r["skipping_ms"] / r["every_ms"] for r in own]
        rows.append([f"`{c}`", number(geometric_mean(ratios), 2), number(min(ratios), 2), number(max(ratios), 2),
                     number(max(r["worst_steps"] for r in own), 2)])
    return table(["configuration", "mean ratio", "least", "greatest", "greatest difference, steps of R16"], rows)


def economy_first(folder):
    t = load(folder, "economy-first")
    return table(["kept from before", "ms"], [[r["kept"], ms(r["ms"])] for r in t.rows]) if t else None


def passes(folder):
    t = load(folder, "passes")
    if not t:
        return None
    columns = [c for c in ("normals", "distance", "estimate", "blur", "upsample") if any(r.get(c) is not None for r in t.rows)]
    rows = [[f"`{r['level']}`", r["shaders"], r["size"], ms(r["frame"])] + [ms(r[c]) for c in columns] for r in t.rows]
    return table(["level", "shaders", "size", "frame"] + columns, rows, 3)


def bandwidth(folder):
    t = load(folder, "bandwidth")
    return table(["what", "how", "ms", "GB/s"], [[r["what"], r["how"], number(r["ms"]), f"{r['gb_per_s']:.0f}"] for r in t.rows],
                 2) if t else None


# The cut is none of a history's motions, and where nothing moves there is no flicker to see.
MOTIONS = ["orbit", "walk", "pan", "dolly", "bend"]


def motion(folder):
    """Settings with a history beside single frames, over all motions of all scenes; the lag where a box leaves."""
    t = load(folder, "motion")
    if not t:
        return None
    columns = (("rmse", "rms"), ("ssim", "mean"), ("flip", "mean"), ("frame_change", "rms"), ("new_rmse", "rms"), ("cpu_ms", "mean"))
    rows = []
    for setting in t.values("setting"):
        own = [r for r in t.where(setting=setting) if r["motion"] in MOTIONS]
        motions = {(r["scene"], r["motion"]) for r in own}  # rays have none where things move
        ultra = [r for r in t.where(setting="ultra") if (r["scene"], r["motion"]) in motions]
        lags = [r["lag"] for r in t.where(setting=setting, motion="box") if setting.endswith("-16")]
        rmse, ssim, flip, change, new, time = (combine((r[c] for r in own), how) for c, how in columns)
        base = [combine((r[c] for r in ultra), how) for c, how in columns]
        rows.append([f"`{setting}`", f"{number(rmse)} ({rmse / base[0]:.2f})", number(ssim, 3), number(flip, 3),
                     f"{number(change)} ({change / base[3]:.2f})", number(new), f"{max(lags):.0f}" if lags else "",
                     f"{ms(time)} ({time / base[5]:.2f})"])
    head = ["setting", "RMSE (of ultra's)", "SSIM", "FLIP", "frame change (of ultra's)", "RMSE of new pixels", "lag, frames",
            "CPU ms (of ultra's)"]
    return table(head, rows)


def motion_command(folder):
    t = load(folder, "motion")
    return f"Made by `{t.command}`; {t.notes['context']}." if t else None
