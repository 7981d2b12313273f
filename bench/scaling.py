"""How the cost grows with image size, samples a pixel, box width and features, and whether the model says so.

The model, in microseconds a pixel and pass; V variables, P pairs of them, m features, s samples a pixel, M drawn, N accepted:
    a + b M + c N V + d P + e P N + f s N (m + 3)
fixed, draws and rejection, columns and normalization, tables of a pair, histograms, weights. Its coefficients are fitted to
all measurements of the sweep together (relative error); a term that would be negative is left out.
"""
import json

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

TERMS = ("a pixel", "M", "N V", "P", "P N", "s N (m + 3)")
SMALL = "--backend opencl --profile paper --samples-factor 2 --noise 0.002 --boxes 21,11,5"
ONE = "--backend opencl --profile paper --boxes {}"
BOXES, COUNTS, SIZES = (5, 7, 11, 17, 25, 35, 55), (2, 4, 8, 16), ("60x34", "120x68", "240x135", "480x270")
FEATURES = ("none", "N", "N,P", "N,P,albedo", "N,P,albedo,uv,N2", "all")


def plan(rounds):
    """The sweep: a frame and its settings for each of the four axes."""
    settings = {"mean": "--boxes none", "small": SMALL}
    settings.update({f"box {b}": ONE.format(b) for b in BOXES})
    settings.update({f"features {f}": ONE.format(17) + ("" if f == "all" else f" --features {f}") for f in FEATURES})
    frame = {"scene": "dof", "size": "240x135", "spp": 4}
    frames = [{"name": f"size {size}", **frame, "size": size, "settings": ["mean", "small"]} for size in SIZES]
    frames += [{"name": f"samples {s}", **frame, "spp": s, "settings": ["mean", "box 17"]} for s in COUNTS]
    frames.append({"name": "240x135", **frame, "settings": ["mean"] + [n for n in settings if n[:3] in ("box", "fea")]})
    return {"rounds": rounds, "settings": settings, "frames": frames}


def medians(path):
    """{(sample file, options): a result line with the median CPU seconds}. Frames of the plan may share a file."""
    groups = {}
    for line in map(json.loads, path.read_text().splitlines()):
        groups.setdefault((line["key"].split(" | ")[0], line["options"]), []).append(line)
    return {key: {**group[0], "cpu": float(np.median([l["cpu"] for l in group]))} for key, group in groups.items()}


def terms(line, samples):
    """The model's terms of a run, summed over its passes."""
    features, random = len(line["features"]), len(line["random"])
    variables = 5 + random + features
    pairs = 3 * (2 + random + features) + features * (2 + random)
    row = np.zeros(len(TERMS))
    for p in line["passes"]:
        n = p["neighbors"]
        drawn = (n - samples) / p["acceptance"] if p["acceptance"] > 0 else 0
        row += [1, drawn, n * variables, pairs, pairs * n, samples * n * (features + 3)]
    return row


def fit(rows, measured):
    """Coefficients, none negative, that make the relative errors smallest."""
    kept = list(range(rows.shape[1]))
    while True:
        scaled = rows[:, kept] / measured[:, None]
        found = np.linalg.lstsq(scaled / np.linalg.norm(scaled, axis=0), np.ones(len(measured)), rcond=None)[0]
        if min(found) >= 0:
            coefficients = np.zeros(rows.shape[1])
            coefficients[kept] = found / np.linalg.norm(scaled, axis=0)
            return coefficients
        kept.pop(int(np.argmin(found)))


def points(table):
    """(axis, value, samples, line, CPU microseconds a pixel without reading) of each run."""
    result, wanted = [], plan(1)
    for frame in wanted["frames"]:
        file = f"{frame['scene']}-{frame['size']}-{frame['spp']}spp.samples.exr"
        width, height = map(int, frame["size"].split("x"))
        for setting in frame["settings"][1:]:
            line = table[file, wanted["settings"][setting]]
            cost = line["cpu"] - table[file, wanted["settings"]["mean"]]["cpu"]
            axis, text = (setting if frame["name"] == "240x135" else frame["name"]).split()
            value = {"size": width * height, "samples": frame["spp"], "features": len(line["features"])}.get(axis)
            result.append((axis, int(text) if value is None else value, frame["spp"], line, 1e6 * cost / (width * height)))
    return sorted(result, key=lambda p: p[:2])


def report(path, picture):
    """Table rows for docs/bench.md; draws the plot."""
    table = points(medians(path))
    rows = np.array([terms(line, samples) for _, _, samples, line, _ in table])
    measured = np.array([p[4] for p in table])
    coefficients = fit(rows, measured)
    model = rows @ coefficients
    plot(table, measured, model, picture)
    out = ["| | measured, us a pixel | model | measured / model |", "|---|---|---|---|"]
    units = {"size": "pixels", "samples": "samples a pixel", "box": "box width", "features": "features"}
    for (axis, value, *_), real, said in zip(table, measured, model):
        ratio = real / said
        text = f"**{ratio:.2f}**" if abs(ratio - 1) > 0.15 else f"{ratio:.2f}"
        out.append(f"| {value} {units[axis]} | {real:.2f} | {said:.2f} | {text} |")
    formula = " + ".join(f"{c:.3g} {term}" for c, term in zip(coefficients, TERMS) if c > 0)
    return out + ["", f"Model, fitted: microseconds a pixel and pass = {formula}."]


def plot(table, measured, model, picture):
    figure, panels = plt.subplots(1, 4, figsize=(13, 3.4))
    titles = {"size": "pixels (boxes 21,11,5)", "samples": "samples a pixel (box 17)", "box": "box width", "features": "features (box 17)"}
    for panel, (axis, title) in zip(panels, titles.items()):
        mine = [i for i, p in enumerate(table) if p[0] == axis]
        x = [table[i][1] for i in mine]
        panel.plot(x, measured[mine], "o", label="measured")
        panel.plot(x, model[mine], "-", label="model")
        if axis == "features":
            panel.set_ylim(bottom=0)
        else:
            panel.set_xscale("log", base=2)
            panel.set_yscale("log", base=2)
            for side in (panel.xaxis, panel.yaxis):
                side.set_major_formatter(lambda number, _: f"{number:g}")
        panel.set_xlabel(title)
    panels[0].set_ylim(min(measured[[p[0] == "size" for p in table]]) / 2, max(measured[[p[0] == "size" for p in table]]) * 2)
    panels[0].set_ylabel("CPU microseconds a pixel")
    panels[0].legend(fontsize=8)
    figure.tight_layout()
    figure.savefig(picture, dpi=90)
