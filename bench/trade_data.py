"""What tables and plots of docs/trade.md share: which points have a name, what dominates what, means over frames."""
import math

PRESETS = ("fast", "balanced", "high")
PROFILES = ("thesis", "paper")
OTHERS = ("OIDN", "OIDN, prefiltered features")
NAMED = ("mean", *PRESETS, *PROFILES, *OTHERS)
MEASURES = ("relMSE", "FLIP")


def is_ours(name):
    """A setting of rpf that filters."""
    return name != "mean" and name not in OTHERS and not name.startswith("mean of")


def pareto(row, measure):
    """The names of our settings that none is both faster and better than, from fast to slow."""
    front, best = [], math.inf
    for name in sorted((n for n in row if is_ours(n)), key=lambda n: row[n]["cpu"]):
        if row[name][measure] < best:
            front.append(name)
            best = row[name][measure]
    return front


def geometric_mean(values):
    return math.exp(sum(math.log(v) for v in values) / len(values))


def summary(points):
    """{setting: {"cpu", "wall", "relMSE", "FLIP"}} over the frames that have all of them: geometric means; errors are parts
    of the plain mean's at 4 samples a pixel; costs are None where they were not measured."""
    names = [n for n in next(iter(points.values())) if sum(n in row for row in points.values()) == len(points)]
    result = {}
    for name in names:
        result[name] = {m: geometric_mean([row[name][m] / row["mean"][m] for row in points.values()]) for m in MEASURES}
        for cost in ("cpu", "wall"):
            costs = [row[name][cost] for row in points.values()]
            result[name][cost] = None if None in costs else geometric_mean(costs)  # means of more samples have none
        result[name]["worst"] = max(row[name]["relMSE"] / row["mean"]["relMSE"] for row in points.values())
    return result
