"""The plots of docs/trade.md: CPU seconds against error, for a frame and over all."""
import re

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.ticker import LogLocator, NullFormatter

from trade_data import MEASURES, OTHERS, PRESETS, PROFILES, is_ours, pareto, summary

STYLES = {**{name: ("o", "tab:red", 7) for name in PRESETS}, **{name: ("s", "tab:blue", 6) for name in PROFILES},
          **{name: ("*", "tab:green", 10) for name in OTHERS}}


def draw(axes, row, measure):
    """One measure: all settings, the front, what has a name, and the plain means as lines."""
    rest = [p for name, p in row.items() if is_ours(name) and name not in STYLES]
    axes.loglog([p["cpu"] for p in rest], [p[measure] for p in rest], ".", color="0.6", markersize=5, label="other settings")
    front = [row[name] for name in pareto(row, measure)]
    axes.loglog([p["cpu"] for p in front], [p[measure] for p in front], "-", color="0.4", linewidth=1, label="nothing faster is better")
    for name, (marker, color, size) in STYLES.items():
        if name not in row:
            continue
        p = row[name]
        axes.loglog(p["cpu"], p[measure], marker, color=color, markersize=size)
        axes.annotate(name, (p["cpu"], p[measure]), xytext=(5, 4), textcoords="offset points", fontsize=7, color=color)
    for name, p in row.items():
        if name.startswith("mean"):
            axes.axhline(p[measure], color="0.75", linewidth=0.8, linestyle=":")
            spp = name.removeprefix("mean of ") if name != "mean" else "4"
            axes.annotate(f"mean of {spp}", (1, p[measure]), xycoords=("axes fraction", "data"), xytext=(-2, 1),
                          textcoords="offset points", ha="right", fontsize=6, color="0.5")
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_major_locator(LogLocator(subs=(1, 2, 5)))
        axis.set_major_formatter(lambda value, _: f"{value:g}")
        axis.set_minor_formatter(NullFormatter())
    axes.set_xlabel("CPU seconds a frame")
    axes.set_ylabel(measure)
    axes.grid(True, which="major", linewidth=0.3)


def save(row, title, path):
    figure, axes = plt.subplots(1, 2, figsize=(10, 4.2))
    for panel, measure in zip(axes, MEASURES):
        draw(panel, row, measure)
    axes[0].legend(fontsize=7, loc="best")
    figure.suptitle(title, fontsize=10)
    figure.tight_layout()
    figure.savefig(path, dpi=90)
    plt.close(figure)


def file_name(frame):
    return "trade-" + re.sub(r"[^a-z0-9]+", "-", frame.lower()).strip("-") + ".png"


def plot_frame(frame, row, folder):
    save(row, frame, folder / file_name(frame))


def plot_summary(points, folder):
    title = f"{len(points)} frames: geometric means; error as a part of the plain mean's at 4 samples a pixel"
    save(summary(points), title, folder / "trade-summary.png")
