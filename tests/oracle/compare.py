"""Compares the C++ tool's trace of a case with the oracle, stage by stage.

    python3 compare.py --tool PATH_TO_rpf_trace --case NAME      python3 compare.py --list

Exit status 0: they agree; 1: they differ; 77: numpy is missing (skipped).
"""
import argparse
import itertools
import json
import subprocess
import sys
import tempfile
import time
from pathlib import Path

try:
    import numpy as np
except ImportError:
    print("skipped: numpy is missing")
    sys.exit(77)

sys.dont_write_bytecode = True      # the source folder stays clean
import cases
import columns
import draw_statistics
import fixed_weights
import oracle
import light_field
import pixel_methods
import scene_frame
from report import Report
from tolerances import TOLERANCE

# ---------------------------------------------------------------- close calls

class TraceDecisions(oracle.Decisions):
    """Decides as the oracle does, but as the trace did where float32 may fall on either side."""

    def __init__(self, traced, close_calls):
        self.traced, self.close_calls = traced, close_calls

    def accepted(self, found, distance, limit):
        slack = TOLERANCE["near_tolerance"]
        surely = oracle.accepted(distance, limit * (1 - slack))
        perhaps = oracle.accepted(distance, limit * (1 + slack)) & ~surely
        choice = surely | (perhaps & np.isin(found, self.traced["neighbors"]))
        self.close_calls["neighbors"] += int((choice != oracle.accepted(distance, limit)).sum())
        return choice

    def bins(self, normalized, K):
        own, traced = oracle.bins_of(normalized, K), np.asarray(self.traced["bins"])
        if traced.shape != own.shape:
            return own
        slack = normalized_bound(normalized)
        possible = ((traced >= oracle.bins_of(normalized - slack, K))
                    & (traced <= oracle.bins_of(normalized + slack, K)))
        self.close_calls["bins"] += int((possible & (traced != own)).sum())
        return np.where(possible, traced, own)

    def outliers(self, filtered):
        own, traced = oracle.outliers(filtered), np.asarray(self.traced["color"], dtype=np.float64)
        open_calls = np.flatnonzero(undecided_outliers(filtered))
        if traced.shape != filtered.shape or not 0 < len(open_calls) <= 8:
            return own
        choices = [own]
        for values in itertools.product((False, True), repeat=len(open_calls)):
            choices.append(own.copy())
            choices[-1][open_calls] = values
        gap = [np.abs(oracle.replace_outliers(filtered, choice) - traced).max() for choice in choices]
        choice = choices[int(np.argmin(gap))]
        self.close_calls["outliers"] += int((choice != own).sum())
        return choice


def undecided_outliers(filtered):
    """Which samples [s] float32 cannot tell. Of two samples both are exactly one deviation off: no close call."""
    if len(filtered) <= 2:
        return np.zeros(len(filtered), dtype=bool)
    mean, std = oracle.moments(filtered)
    edge = std * (1 + oracle.OUTLIER_SLACK)
    slack = TOLERANCE["outlier"] * std + TOLERANCE["outlier_value"] * np.abs(filtered).max(axis=0)
    return (np.abs(np.abs(filtered - mean) - edge) <= slack).any(axis=1)


# ---------------------------------------------------------------- bounds

def spread(values):
    """Largest magnitude [V] and range [V] of the non-missing values [N, V]; 0 where there are none."""
    magnitude = np.nan_to_num(np.abs(values)).max(axis=0)
    low = np.where(np.isnan(values), np.inf, values).min(axis=0)
    high = np.where(np.isnan(values), -np.inf, values).max(axis=0)
    return magnitude, np.maximum(high - low, 0.0)


def normalized_bound(normalized):
    """Bound [V] on float32's error of normalized values [N, V]."""
    return TOLERANCE["normalized"] + TOLERANCE["normalized_relative"] * np.abs(normalized).max(axis=0)


def information_bound(information, bins, n, units_per_bit):
    """Bound on the C++ mutual information. N I is a sum of integers round(S n log2 n), each half a unit off, and is set
    to 0 up to the largest sum of these errors, E = (B^2 + 2 B + 1)/2 units: so 2 E units of ln 2 / (S N) nats."""
    rounding = (bins ** 2 + 2 * bins + 1) / 2
    return 2 * rounding * np.log(2) / (units_per_bit * n) + TOLERANCE["information_relative"] * information


def check_units(report, frame, trace):
    """units_per_bit, S, must be a power of two and large enough to be of use."""
    for t, one in enumerate(trace["passes"]):
        scale, bins = one["units_per_bit"], frame.settings["bins"]
        largest = max(oracle.requested_samples(frame.settings, one["box"], s) for s in frame.counts)
        largest = max(largest, frame.counts.max())
        report.check("mutual_information", np.frexp(scale)[0], 0.5, 0, f"pass {t}", ".units_per_bit mantissa")
        report.check("mutual_information", information_bound(0.0, bins, largest, scale), 0,
                     TOLERANCE["information_table"], f"pass {t}", ".units_per_bit rounding")


def color_bound(color, mean_radiance):
    """Bound on filtered colors, any shape."""
    return TOLERANCE["color"] * np.maximum(np.abs(color), TOLERANCE["color_floor"] * mean_radiance)


# ---------------------------------------------------------------- the stages

def as_array(values):
    """A list of the trace as an array, null as NaN."""
    return np.array(values, dtype=np.float64)


def check_variables(report, case, trace):
    """The modeled random parameters and features must be the oracle's, in any order."""
    frame = scene_frame.load_frame(case)
    for what, own in (("random", frame.random), ("features", frame.features)):
        if sorted(trace[what]) != sorted(own):
            return report.fail("variables", "frame", f"{what}: trace {trace[what]}, oracle {own}")
    report.worst["variables"] = (0.0, 0.0, 0.0)
    return True


def check_draws(report, frame, tables, boxes):
    """Number, range and statistics of the draws; tables {(pass, pixel): [draws, attempts, 3]}."""
    for (t, pixel), table in tables.items():
        s, half = frame.counts[pixel], (boxes[t] - 1) // 2
        expected = (oracle.draw_count(frame.settings, boxes[t], s), frame.settings["redraws"] + 1, 3)
        where = place(frame, t, pixel)
        report.check("draws", table.shape, expected, 0, where, ".shape")
        low, high = np.array([-half, -half, 0]), np.array([half, half, 2 ** 32 - 1])
        report.check("draws", np.clip(table, low, high), table, 0, where, ".range")
    if report.failures:
        return
    report.check("draws", draw_statistics.repeated(tables.values()), 0, 0, "frame", ".repeated_tables")
    for t, box in enumerate(boxes):
        table = np.concatenate([table for (u, _), table in tables.items() if u == t])
        for name, z in (("offsets", draw_statistics.offsets(table, box)), ("words", draw_statistics.words(table)),
                        ("correlation", draw_statistics.correlation(table))):
            report.check("draws", z, 0, TOLERANCE["draw_statistics"], f"pass {t}", f".{name}")


def place(frame, t, pixel):
    return f"pass {t}, pixel x {pixel % frame.width} y {pixel // frame.width}"


def check_neighborhood(report, frame, pixel, traced, stages, where):
    """Own moments, tolerance and neighbors; where all own values are missing the moments do not matter."""
    own = oracle.own_features(frame, pixel)
    there = ~np.isnan(own).all(axis=0)
    magnitude, span = spread(own)
    for stage, bound in (("own_mean", TOLERANCE["mean"] * magnitude), ("own_std", TOLERANCE["std"] * span)):
        got = as_array(traced[stage])
        got = np.where(there, got, 0.0) if got.shape == there.shape else got
        report.check(stage, got, np.where(there, stages[stage], 0.0), bound, where, names=frame.features)
    got = as_array(traced["tolerance"])
    got = np.where(np.isnan(got) | (got > 1e30), np.inf, got)
    report.check("tolerance", got, stages["tolerance"], TOLERANCE["tolerance"] * stages["tolerance"], where,
                 names=frame.features)
    return report.check("neighbors", traced["neighbors"], stages["neighbors"], 0, where)


def check_statistics(report, frame, traced, stages, where):
    """Moments over N and normalized values; bins and histograms."""
    magnitude, span = spread(frame.values[stages["neighbors"]])
    bounds = {"mean": TOLERANCE["mean"] * magnitude, "std": TOLERANCE["std"] * span,
              "normalized": normalized_bound(stages["normalized"]), "bins": 0}
    for stage, bound in bounds.items():
        report.check(stage, as_array(traced[stage]), stages[stage], bound, where, names=frame.variables)
    check_histograms(report, frame, traced, stages, where)


def check_histograms(report, frame, traced, stages, where):
    """The same pairs, and the same counts for each."""
    names = [(f"{frame.variables[x]}|{frame.variables[y]}", (x, y)) for x, y in stages["histograms"]]
    for stage in ("histograms", "mutual_information"):
        if set(traced[stage]) != {name for name, _ in names}:
            return report.fail(stage, where, f"pairs differ: {sorted(set(traced[stage]) ^ {n for n, _ in names})}")
    got = np.array([np.ravel(traced["histograms"][name]) for name, _ in names])
    expected = np.array([stages["histograms"][pair].ravel() for _, pair in names])
    if got.shape != expected.shape:
        return report.fail("histograms", where, f"shape {got.shape}, expected {expected.shape}")
    first_wrong = (got != expected).any(axis=1).argmax()
    return report.check("histograms", got[first_wrong], expected[first_wrong], 0, where, f" {names[first_wrong][0]}")


def check_dependencies(report, frame, traced, stages, units_per_bit, where):
    """Mutual information of every pair, then W, alpha and beta."""
    settings, n = frame.settings, len(stages["bins"])
    for x, y in stages["histograms"]:
        name = f"{frame.variables[x]}|{frame.variables[y]}"
        before_correction = oracle.mutual_information(stages["histograms"][x, y])
        bound = information_bound(before_correction, settings["bins"], n, units_per_bit)
        report.check("mutual_information", traced["mutual_information"].get(name, np.nan),
                     stages["mutual_information"][x, y], bound, where, f" {name}")
    for stage in ("W_c_r", "W_f_r", "W_c_f", "fraction_random", "alpha", "beta"):
        names = {"W_c_r": scene_frame.COLOR, "alpha": scene_frame.COLOR, "fraction_random": None}.get(stage, frame.features)
        report.check(stage, as_array(traced[stage]), stages[stage], TOLERANCE["fraction"], where, names=names)


def check_pixel(report, frame, pixel, traced, stages, units_per_bit, where):
    """All stages of one pixel and pass; what follows from a wrong neighborhood is not compared."""
    mean_radiance = np.abs(frame.values[:, :3]).mean()
    report.check("start", as_array(traced["start"]), stages["start"], color_bound(stages["start"], mean_radiance), where)
    if check_neighborhood(report, frame, pixel, traced, stages, where):
        check_statistics(report, frame, traced, stages, where)
        check_dependencies(report, frame, traced, stages, units_per_bit, where)
    for stage in ("filtered", "color"):
        report.check(stage, as_array(traced[stage]), stages[stage], color_bound(stages[stage], mean_radiance), where)


def index_passes(frame, trace):
    """[{pixel: traced stages}] of the trace."""
    return [{p["y"] * frame.width + p["x"]: p for p in one["pixels"]} for one in trace["passes"]]


def check_coverage(report, frame, trace, passes):
    """Every pass must be there with its box width, and in it every pixel that has samples, once."""
    report.check("variables", [p["box"] for p in trace["passes"]], frame.settings["boxes"], 0, "frame", " boxes")
    for t, pixels in enumerate(passes):
        listed = sorted(p["y"] * frame.width + p["x"] for p in trace["passes"][t]["pixels"])
        report.check("variables", listed, np.flatnonzero(frame.counts), 0, f"pass {t}", " pixels")


def compare(case, trace):
    """The Report on a trace of the case."""
    report = Report()
    if not check_variables(report, case, trace):
        return report
    frame = scene_frame.load_frame(case, trace["random"], trace["features"])
    traced = index_passes(frame, trace)
    check_coverage(report, frame, trace, traced)
    if report.failures:
        return report
    attempts = frame.settings["redraws"] + 1
    tables = {(t, pixel): np.array(one["draws"], dtype=np.int64).reshape(len(one["draws"]), attempts, 3)
              for t, pixels in enumerate(traced) for pixel, one in pixels.items()}
    check_draws(report, frame, tables, frame.settings["boxes"])
    check_units(report, frame, trace)
    passes, image = oracle.run(frame, lambda t, pixel: tables[t, pixel],
                               lambda t, pixel: TraceDecisions(traced[t][pixel], report.close_calls))
    for t, pixels in enumerate(passes):
        for pixel, stages in pixels.items():
            check_pixel(report, frame, pixel, traced[t][pixel], stages, trace["passes"][t]["units_per_bit"],
                        place(frame, t, pixel))
    mean_radiance = np.abs(frame.values[:, :3]).mean()
    report.check("image", as_array(trace["image"]), image, color_bound(image, mean_radiance), "image")
    print_summary(frame, passes)
    return report


def print_summary(frame, passes):
    """What the case exercises, so that a case that tests nothing is seen."""
    for t, pixels in enumerate(passes):
        one = list(pixels.values())
        found = sum(len(p["neighbors"]) for p in one) / len(one)
        drawn = sum(p["drawn"] for p in one)
        accepted = sum(len(p["neighbors"]) - frame.counts[pixel] for pixel, p in pixels.items()) / max(drawn, 1)
        alpha = np.concatenate([p["alpha"] for p in one])
        beta = np.concatenate([p["beta"] for p in one] + [np.zeros(1)])
        print(f"pass {t}, box {frame.settings['boxes'][t]:2}: {found:6.1f} neighbors, {accepted:.0%} accepted, W_c^r "
              f"{np.mean([p['fraction_random'] for p in one]):.3f}, alpha {alpha.mean():.3f} "
              f"({np.mean((alpha > 0) & (alpha < 1)):.0%} inside), beta {beta.mean():.3f} "
              f"({np.mean((beta > 0) & (beta < 1)):.0%} inside)")


# ---------------------------------------------------------------- the program

def trace_of(tool, case, folder):
    """Runs the tool on the case; returns its trace, or exits with 1."""
    source, target = Path(folder) / "case.json", Path(folder) / "trace.json"
    source.write_text(json.dumps(case))
    done = subprocess.run([tool, str(source), str(target)], capture_output=True, text=True)
    if done.returncode != 0 or not target.exists():
        print(f"{tool} failed with {done.returncode}:\n{done.stdout}{done.stderr}")
        sys.exit(1)
    return json.loads(target.read_text())


def witness_of(method):
    """What compares a trace of a method with the oracle."""
    if method in ("nlm", "gem", "sbf", "axis-aligned"):
        return pixel_methods.compare
    if method == "lightfield":
        return light_field.compare
    if method == "multidim":
        return columns.compare
    return compare if method == "rpf" else fixed_weights.compare


def main():
    parser = argparse.ArgumentParser(description="Compares rpf_trace with the oracle.")
    parser.add_argument("--tool", help="path of rpf_trace")
    parser.add_argument("--case", choices=list(cases.CASES), help="name of the case")
    parser.add_argument("--list", action="store_true", help="list the cases")
    options = parser.parse_args()
    if options.list:
        print("\n".join(cases.CASES))
        return 0
    if not (options.tool and options.case):
        parser.error("--tool and --case are needed")
    started = time.monotonic()
    case = cases.make(options.case)
    with tempfile.TemporaryDirectory() as folder:
        trace = trace_of(options.tool, case, folder)
    try:
        report = witness_of(case["settings"]["method"])(case, trace)
    except KeyError as missing:
        print(f"the trace lacks {missing}")
        return 1
    report.print()
    print(f"{options.case}: {'DIFFERENT' if report.failures else 'ok'} in {time.monotonic() - started:.1f} s")
    return 1 if report.failures else 0


if __name__ == "__main__":
    sys.exit(main())
