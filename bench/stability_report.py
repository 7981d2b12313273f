"""Measures and draws the curves of docs/stability.md. Usage: stability_report.py [BUILD [PICTURE...]]

BUILD is a release build with tests (default build/release). PICTURE: exp, radiance, offset, samples; default all. Needs
numpy and matplotlib; prints the numbers that the pictures show.
"""
import json
import os
import subprocess
import sys
from pathlib import Path

import matplotlib
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot as plt

PROJECT = Path(__file__).resolve().parent.parent
sys.dont_write_bytecode = True
sys.path.insert(0, str(PROJECT / "tests/oracle"))
import cases
import compare
import oracle
import scene_frame

BUILD = Path(sys.argv[1] if len(sys.argv) > 1 else PROJECT / "build/release").resolve()
TRACE, RPF, TO_FLOATS = BUILD / "tests/rpf_trace", BUILD / "rpf", BUILD / "tests/image_to_floats"
WORK, PICTURES = BUILD / "stability-report", PROJECT / "docs/images/stability"
BACKENDS = ("cpu", "opencl")
NOTHING = 1e-9                   # what an error of 0 is drawn as
STYLE = {"deviation": "C0", "information": "C1", "W, alpha, beta": "C2", "filtered": "C3"}


def trace_of(case, backend):
    os.environ["RPF_TEST_BACKEND"] = backend
    return compare.trace_of(str(TRACE), case, WORK)


def single_pass(seed, change, **settings):
    return cases.simple(seed, 9, 7, boxes=[9], change=change, **settings)


def stages(case, trace):
    """The oracle's frame, and [(traced, oracle's) stages] of the pixels of the first pass."""
    frame = scene_frame.load_frame(case, trace["random"], trace["features"])
    traced = compare.index_passes(frame, trace)[0]
    attempts = frame.settings["redraws"] + 1
    table = lambda t, pixel: np.array(traced[pixel]["draws"], dtype=np.int64).reshape(-1, attempts, 3)
    close = {"neighbors": 0, "bins": 0, "outliers": 0}
    passes, _ = oracle.run(frame, table, lambda t, pixel: compare.TraceDecisions(traced[pixel], close))
    return frame, [(traced[pixel], one) for pixel, one in passes[0].items()]


def errors(frame, pairs, columns=slice(None)):
    """The largest error of each stage; deviations and colors relative, the others absolute."""
    worst = dict.fromkeys(STYLE, 0.0)
    for traced, exact in pairs:
        std, truth = np.array(traced["std"])[columns], exact["std"][columns]
        there = (truth > 0) & (std > 0)
        measured = {"deviation": np.abs(std[there] / truth[there] - 1),
                    "information": [abs(traced["mutual_information"][f"{frame.variables[x]}|{frame.variables[y]}"]
                                        - exact["mutual_information"][x, y]) for x, y in exact["histograms"]],
                    "W, alpha, beta": np.concatenate([np.abs(np.array(traced[k]) - exact[k]) for k in ("W_c_r", "alpha", "beta")]),
                    "filtered": np.abs(np.array(traced["filtered"], dtype=float) - exact["filtered"])
                    / np.maximum(np.abs(exact["filtered"]), 1e-300)}
        for stage, values in measured.items():
            worst[stage] = max(worst[stage], float(np.max(values, initial=0.0)))
    return worst


def draw_errors(axes, x, measured):
    """Lines for the reference, crosses for OpenCL: {backend: [errors at each x]}."""
    for stage, color in STYLE.items():
        line = [max(e[stage], NOTHING) for e in measured["cpu"]]
        axes.loglog(x, line, color=color, label=stage)
        axes.loglog(x, [max(e[stage], NOTHING) for e in measured["opencl"]], "x", markersize=4, color=color)


def save(figure, name):
    figure.tight_layout()
    PICTURES.mkdir(parents=True, exist_ok=True)
    figure.savefig(PICTURES / f"{name}.png", dpi=90)


# ---------------------------------------------------------------- the exponential

def draw_exp():
    tests = subprocess.run([BUILD / "tests/rpf_extremes_tests", "--gtest_filter=ExpOfEveryFloat.IsWithin*"], capture_output=True,
                           text=True, env={**os.environ, "RPF_TEST_BACKEND": "cpu"}).stdout.splitlines()
    rows = [(float(line.split()[1]), int(line.split()[2])) for line in tests if line.startswith("ulp ")]
    print(next(line for line in tests if line.startswith("largest")))
    figure, axes = plt.subplots(figsize=(6.4, 2.8))
    axes.bar([ulp + 0.025 for ulp, _ in rows], [count for _, count in rows], width=0.045)
    axes.set(yscale="log", xlabel="error of rpf_exp in units in the last place", ylabel="floats from -87 to 0", xlim=(0, 1))
    save(figure, "exp")


# ---------------------------------------------------------------- radiance

def scaled(factor):
    def change(channels, rng, counts):
        for name in "RGB":
            channels[name] = channels[name] * factor
    return change


def draw_radiance():
    exponents = np.arange(-44, 39, 4)
    measured = {backend: [] for backend in BACKENDS}
    for exponent in exponents:
        case = single_pass(35, scaled(10.0 ** exponent))
        for backend in BACKENDS:
            measured[backend].append(errors(*stages(case, trace_of(case, backend))))
        print(f"radiance 1e{exponent}:", {k: float(f"{v:.2g}") for k, v in measured["cpu"][-1].items()},
              "same" if measured["cpu"][-1] == measured["opencl"][-1] else measured["opencl"][-1], flush=True)
    figure, axes = plt.subplots(figsize=(6.4, 3.4))
    draw_errors(axes, 10.0 ** exponents, measured)
    axes.axvspan(1e-45, 1.2e-38, color="0.9")
    axes.set(xlabel="radiance (gray: subnormal floats)", ylabel="largest error against double", ylim=(NOTHING / 2, 1e-3))
    axes.legend(fontsize=8)
    save(figure, "radiance")


# ---------------------------------------------------------------- offset

WORLD_SIZE = 10                  # the scene is then some 30 units large


def moved(offset, rounded_plain=False, plain=False):
    """World positions at an offset; or at the origin, rounded as they are there; or at the origin."""
    def change(channels, rng, counts):
        for axis in "XYZ":
            here = channels["feature.P." + axis] * WORLD_SIZE
            there = np.float32(here + offset).astype(float)
            channels["feature.P." + axis] = here if plain else there - offset if rounded_plain else there
    return change


def naive_errors(frame, pairs):
    """Largest relative error of variances of positions in float32: E[x2] - E[x]2, and two passes without a shift."""
    one, two = 0.0, 0.0
    columns = [c for c, name in enumerate(frame.variables) if name.startswith("feature.P.")]
    for _, exact in pairs:
        values = frame.values[exact["neighbors"]][:, columns]
        truth, x = values.var(axis=0), values.astype(np.float32)
        there = truth > 0
        n = np.float32(len(x))
        total = lambda a: np.add.accumulate(a, axis=0, dtype=np.float32)[-1]
        mean = total(x) / n
        for name, variance in (("one", total(x * x) / n - mean * mean), ("two", total((x - mean) ** 2) / n)):
            error = float(np.max(np.abs(variance[there] / truth[there] - 1), initial=0.0))
            one, two = (max(one, error), two) if name == "one" else (one, max(two, error))
    return one, two


def picture_difference(a, b):
    a, b = np.array(a), np.array(b)
    return float(np.max(np.abs(a - b) / np.maximum(np.abs(b), 1e-6)))


def draw_offset():
    exponents = np.arange(0, 8.01, 0.5)
    measured, naive, same_input, any_input = {backend: [] for backend in BACKENDS}, [], [], []
    plain = trace_of(single_pass(36, moved(0, plain=True)), "cpu")["image"]
    for exponent in exponents:
        offset = float(np.round(10 ** exponent))
        case = single_pass(36, moved(offset))
        for backend in BACKENDS:
            trace = trace_of(case, backend)
            frame, pairs = stages(case, trace)
            measured[backend].append(errors(frame, pairs))
        naive.append(naive_errors(frame, pairs))
        rounded = trace_of(single_pass(36, moved(offset, rounded_plain=True)), "cpu")["image"]
        same_input.append(picture_difference(trace["image"], rounded))
        any_input.append(picture_difference(trace["image"], plain))
        print(f"offset {offset:g}:", {k: float(f"{v:.2g}") for k, v in measured["cpu"][-1].items()},
              "same" if measured["cpu"][-1] == measured["opencl"][-1] else measured["opencl"][-1],
              f"naive {naive[-1][0]:.2g}, two passes {naive[-1][1]:.2g}; picture against the same rounded input "
              f"{same_input[-1]:.2g}, against the input unrounded {any_input[-1]:.2g}", flush=True)
    figure, (left, right) = plt.subplots(1, 2, figsize=(9.6, 3.6))
    x = 10.0 ** exponents
    draw_errors(left, x, measured)
    left.loglog(x, [n[0] for n in naive], "k:", linewidth=1, label="variance as E[x²] - E[x]²")
    left.loglog(x, [n[1] for n in naive], "k--", linewidth=1, label="variance in two passes, not shifted")
    left.set(xlabel="world offset of a scene of 30 units", ylabel="largest error against double")
    left.legend(fontsize=7)
    right.loglog(x, [max(e, NOTHING) for e in any_input], label="against the scene at the origin")
    right.loglog(x, [max(e, NOTHING) for e in same_input], label="... with positions rounded as they are here")
    right.axhline(1e-4, color="0.7", linewidth=1)
    right.set(xlabel="world offset of a scene of 30 units", ylabel="largest relative difference of the picture")
    right.legend(fontsize=7)
    save(figure, "offset")


# ---------------------------------------------------------------- numbers of samples

SEEDS = {1: 12, 4: 6, 16: 6, 64: 6, 256: 3, 1024: 3}    # of each number of samples a pixel
COUNTS = list(SEEDS)
SIZE = ["--size", "24x14"]
FILTERS = {"plain mean": ["--boxes", "none"], "thesis": ["--profile", "thesis", "--boxes", "7"],
           "paper": ["--profile", "paper", "--boxes", "7"]}


def floats(image):
    out = WORK / "floats"
    width, height = map(int, subprocess.run([TO_FLOATS, image, out], check=True, capture_output=True).stdout.split())
    return np.fromfile(out, np.float32).reshape(height, width, 3).astype(float)


def run(*arguments):
    subprocess.run([RPF, *map(str, arguments), "-q"], check=True, stdout=subprocess.DEVNULL)


def bias_and_error(pictures, means, reference):
    """Root mean squares relative to the reference's mean: of the bias, the mean over seeds of picture - plain mean, without
    the part that chance explains; and of the error of one picture."""
    change, size = np.array(pictures) - np.array(means), reference.mean()
    bias = np.mean(change.mean(axis=0) ** 2 - change.var(axis=0, ddof=1) / len(change))
    return float(np.sqrt(max(bias, 0)) / size), float(np.sqrt(np.mean((np.array(pictures) - reference) ** 2)) / size)


def measure_samples(count, truth):
    """{filter: (bias, error)} with so many samples a pixel."""
    samples, image, pictures = WORK / "samples.exr", WORK / "image.exr", {name: [] for name in FILTERS}
    for seed in range(1, 1 + SEEDS[count]):
        run("scene", "dof", *SIZE, "--spp", count, "--seed", seed, "-o", samples)
        for name, options in FILTERS.items():
            run(samples, *options, "--backend", "opencl" if count > 8 else "cpu", "-o", image)
            pictures[name].append(floats(image))
    return {name: bias_and_error(pictures[name], pictures["plain mean"], truth) for name in FILTERS}


def draw_samples():
    """Measurements are kept in a file; what is deleted there is measured again."""
    reference, page = WORK / "reference.exr", WORK / "samples.json"
    if not reference.exists():
        run("scene", "dof", *SIZE, "--reference", 65536, "--sampler", "sobol", "-o", reference)
    truth, book = floats(reference), json.loads(page.read_text()) if page.exists() else {}
    for count in map(str, COUNTS):
        if count not in book:
            book[count] = measure_samples(int(count), truth)
            page.write_text(json.dumps(book))
        print(f"s = {count}: (bias, error)", {name: tuple(float(f"{v:.3g}") for v in book[count][name]) for name in FILTERS}, flush=True)
    result = {name: [book[str(count)][name] for count in COUNTS] for name in FILTERS}
    figure, axes = plt.subplots(figsize=(6.4, 3.8))
    for color, name in zip(("k", "C0", "C3"), FILTERS):
        axes.loglog(COUNTS, [e for _, e in result[name]], color=color, label=f"{name}: error")
        if name != "plain mean":
            axes.loglog(COUNTS, [max(b, 1e-5) for b, _ in result[name]], "--", color=color, label=f"{name}: bias")
    axes.set_xticks(COUNTS, COUNTS)
    axes.minorticks_off()
    axes.set(xlabel="samples a pixel", ylabel="root mean square / mean of the reference")
    axes.legend(fontsize=8)
    save(figure, "samples")


def main():
    WORK.mkdir(parents=True, exist_ok=True)
    pictures = {"exp": draw_exp, "radiance": draw_radiance, "offset": draw_offset, "samples": draw_samples}
    for name in sys.argv[2:] or pictures:
        pictures[name]()


main()
