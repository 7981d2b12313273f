"""Measures where the time goes and how it grows, and writes the tables and the plot of docs/bench.md.

Usage: bench_report.py [--build BUILD] [--bench RPF_BENCH] [--rounds N]

BUILD is a release build (default build/release), RPF_BENCH the program of ./run bench. Needs numpy and matplotlib. Measurements are
kept in BUILD/bench-report; what is deleted there is measured again.
"""
import argparse
import json
import subprocess
from pathlib import Path

import scaling
from marked_page import replace

PROJECT = Path(__file__).resolve().parent.parent
PAGE, PICTURE = PROJECT / "docs/bench.md", PROJECT / "docs/images/scaling.png"


def measure_phases(program, output):
    if not output.exists():
        temporary = output.with_suffix(".part")
        subprocess.run([program, "--benchmark_repetitions=3", "--benchmark_report_aggregates_only=true",
                        f"--benchmark_out={temporary}", "--benchmark_out_format=json"], check=True)
        temporary.rename(output)
    return [b for b in json.loads(output.read_text())["benchmarks"] if b.get("aggregate_name") == "median"]


def roof_rows(benchmarks):
    rows = ["| roof, a core and second | OpenCL | reference |", "|---|---|---|"]
    names = {"multiply_add": "multiplications and additions, each rounded, 1e9", "fused_multiply_add": "the same, fused, 1e9",
             "exp": "exponentials, 1e9", "popcount": "AND and popcount of 64 bits, 1e9", "increments": "increments of joint histograms, 1e9",
             "read": "GB read from memory", "read_cached": "GB read from the L2 cache", "random_records": "random records of 64 bytes, 1e9"}
    found = {tuple(b["run_name"].split("/")[0].split(".")[1:]): b["1e9/s"] for b in benchmarks if b["run_name"].startswith("roof")}
    for name, text in names.items():
        cells = [f"{found[backend, name]:.3g}" if (backend, name) in found else "-" for backend in ("opencl", "cpu")]
        rows.append(f"| {text} | " + " | ".join(cells) + " |")
    return rows


def phase_rows(benchmarks):
    rows = ["| phase | unit | " + " | ".join(f"b = {b}" for b in (55, 17, 7)) + " |", "|---|---|---|---|---|"]
    found = {b["run_name"].split("/")[0]: b for b in benchmarks}
    for backend in ("opencl", "cpu"):
        for phase in ("draw", "gather", "prepare", "information", "weights"):
            cells = [found.get(f"dof.4spp.240x135.{backend}.paper.{box}.{phase}") for box in (55, 17, 7)]
            if cells[0]:
                unit = next(k for k in cells[0] if k.startswith("ns/"))
                rows.append(f"| {backend}: {phase} | {unit.replace('_', ' ')} | " + " | ".join(phase_cell(c, unit) for c in cells) + " |")
    return rows


def phase_cell(benchmark, unit):
    if benchmark is None:
        return "-"
    roof = f", {benchmark['% of roof']:.0f} %" if "% of roof" in benchmark else ""
    share = f"; {benchmark['us/pixel']:.2f} us" if "us/pixel" in benchmark else ""
    return f"{benchmark[unit]:.3g}{roof}{share}"


def frame_rows(benchmarks):
    rows = ["| frame | CPU s | wall s | acceptance | ns a neighbor | us a pixel |", "|---|---|---|---|---|---|"]
    for b in benchmarks:
        if "acceptance" in b:
            rows.append(f"| `{b['run_name'].split('/')[0]}` | {b['cpu_time'] / 1e3:.2f} | {b['real_time'] / 1e3:.2f} | {b['acceptance']:.2f} | "
                        f"{b['ns/neighbor']:.1f} | {b['us/pixel']:.1f} |")
    return rows


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--build", type=Path, default=PROJECT / "build/release")
    parser.add_argument("--bench", type=Path, default=PROJECT / "build/bench/bench/rpf_bench")
    parser.add_argument("--rounds", type=int, default=5)
    options = parser.parse_args()
    work = options.build.resolve() / "bench-report"
    work.mkdir(exist_ok=True)
    (work / "plan.json").write_text(json.dumps(scaling.plan(options.rounds)))
    results = work / "scaling.jsonl"
    subprocess.run([options.build.resolve() / "rpf", "bench", "sweep", work / "plan.json", "-o", results], check=True)
    benchmarks = measure_phases(options.bench, work / "phases.json")
    page = PAGE.read_text(encoding="utf-8")
    page = replace(page, "roofs", roof_rows(benchmarks))
    page = replace(page, "phases", phase_rows(benchmarks))
    page = replace(page, "whole", frame_rows(benchmarks))
    page = replace(page, "scaling", scaling.report(results, PICTURE))
    PAGE.write_text(page, encoding="utf-8")


main()
