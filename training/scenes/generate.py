"""Random scenes to train on: samples by Mitsuba 3, and a reference of each.

Usage: generate.py --out DIR --first SEED --count N [--size 128x128] [--spp 8] [--reference-spp 180]
                   [--stratified-share 0.33] [--processes CORES] [--frames CACHE]

Writes SEED.samples.rpf and SEED.reference.rpf (one sample a pixel: the mean), both raw sample files (docs/file-format.md)
that `rpf` reads. Files appear as a whole, and scenes are skipped whose files are there or that to_frames.py has turned into
CACHE: stop it at any time. A seed gives the same scene on every run.
"""
import argparse
import gc
import multiprocessing
import os
import sys
import time
from pathlib import Path

for folder in ("../../python", ".."):
    sys.path.insert(0, str(Path(__file__).resolve().parent / folder))
os.environ.setdefault("OMP_NUM_THREADS", "1")

SCENES_A_PROCESS = 40  # then a new one: bounds memory
ATTEMPTS = 40


def write_scene(folder, seed, options):
    """Makes one scene and writes its two files. -> a line about it"""
    from rpf.mitsuba import write_samples
    from scene import make_scene
    start = time.process_time()
    samples, reference = make_scene(seed, options, ATTEMPTS)
    write_samples(folder / f"{seed}.reference.rpf", reference)
    write_samples(folder / f"{seed}.samples.rpf", samples)
    gc.collect()
    facts = ", ".join(f"{k.removeprefix('scene:')} {v:.3g}" if isinstance(v, float) else f"{k.removeprefix('scene:')} {v}"
                      for k, v in samples.metadata.items() if k.startswith("scene:"))
    return f"{seed}: {time.process_time() - start:.1f} CPU seconds, {facts}"


def start_process():
    import drjit
    from rpf.mitsuba import select_variant
    select_variant()
    drjit.set_thread_count(1)


def check_modules():
    """What every process imports: a pool would start one after the other for ever where one of them is missing."""
    try:
        import drjit  # noqa: F401
        import mitsuba  # noqa: F401
        import rpf.mitsuba  # noqa: F401
    except ImportError as error:
        sys.exit(f"{error}; install training/requirements.txt, and run this where it lies in the repository")


def work(task):
    try:
        return write_scene(*task)
    except RuntimeError as error:
        return f"{task[1]}: left out: {error}"


def is_made(seed, options):
    turned = options.frames and (options.frames / f"{seed}.samples.npy").exists()
    return turned or (options.out / f"{seed}.samples.rpf").exists()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=Path, required=True)
    parser.add_argument("--first", type=int, required=True)
    parser.add_argument("--count", type=int, required=True)
    parser.add_argument("--size", default="128x128", type=lambda text: tuple(int(n) for n in text.split("x")))
    parser.add_argument("--spp", type=int, default=8)
    parser.add_argument("--reference-spp", type=int, default=180)
    parser.add_argument("--stratified-share", type=float, default=0.33)
    parser.add_argument("--processes", type=int, default=os.cpu_count())
    parser.add_argument("--frames", type=Path)
    options = parser.parse_args()
    check_modules()
    options.out.mkdir(parents=True, exist_ok=True)
    seeds = [s for s in range(options.first, options.first + options.count) if not is_made(s, options)]
    context = multiprocessing.get_context("spawn")
    with context.Pool(options.processes, start_process, maxtasksperchild=SCENES_A_PROCESS) as pool:
        for line in pool.imap_unordered(work, [(options.out, seed, options) for seed in seeds]):
            print(line, flush=True)


if __name__ == "__main__":
    sys.exit(main())
