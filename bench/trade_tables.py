"""The tables of docs/trade.md."""
from trade_data import NAMED, is_ours, pareto, summary
from trade_plots import file_name


def chosen_table(points):
    """What has a name, over all frames."""
    over_all = summary(points)
    rows = ["| | CPU s | wall s | relMSE | worst frame | FLIP |", "|---|---|---|---|---|---|"]
    for name in NAMED:
        if name in over_all:
            s = over_all[name]
            rows.append(f"| {name} | {s['cpu']:.3g} | {s['wall']:.3g} | {s['relMSE']:.3f} | {s['worst']:.2f} | {s['FLIP']:.3f} |")
    return rows


def settings_table(settings, points):
    """All settings, from fast to slow; those on a front of the summary are bold."""
    over_all = summary(points)
    fronts = set(pareto(over_all, "relMSE")) | set(pareto(over_all, "FLIP"))
    rows = ["| options | CPU s | relMSE | worst frame | FLIP |", "|---|---|---|---|---|"]
    for name in sorted(filter(is_ours, over_all), key=lambda n: over_all[n]["cpu"]):
        s, options = over_all[name], settings[name].replace("--backend opencl ", "")
        text = f"**`{options}`**" if name in fronts else f"`{options}`"
        label = f" = {name}" if name in NAMED else ""
        rows.append(f"| {text}{label} | {s['cpu']:.3g} | {s['relMSE']:.3f} | {s['worst']:.2f} | {s['FLIP']:.3f} |")
    return rows


def frames_table(points):
    """A frame each: what has a name."""
    names = [n for n in NAMED if any(n in row for row in points.values())]
    rows = ["| relMSE, FLIP, energy; CPU s | " + " | ".join(names) + " |", "|---" * (len(names) + 1) + "|"]
    for frame, row in points.items():
        rows.append(f"| [{frame}](images/{file_name(frame)}) | " + " | ".join(cell(row.get(n)) for n in names) + " |")
    return rows


def cell(p):
    if p is None:
        return "-"
    cost = "" if p["cpu"] is None else f"; {p['cpu']:.2f}"
    return f"{p['relMSE']:.3g}, {p['FLIP']:.3f}, {p['energy']:.3f}{cost}"
