"""Trains one network. Resumable: all state is in --run, written every few minutes; stop it at any time.

Usage: train.py --run DIR --frames CACHE --validation CACHE --hours H [--channels 16,24,32,48] [--sample-features 8] [--seed 1]
                [--embedding 8] [--dilations 8,4,2,1] [--albedo-dilations 2,1] [--without second,lens,time,film,light,bsdf]
                [--start CHECKPOINT|NETWORK.rpfnet] [--rate 1e-3]
--start goes on from a network that is as wide or narrower (widen.py): a checkpoint's or one that ships; its rate may be lower. Passes
begin as those of the nearest dilation. --without: groups of inputs that the network shall not look at, which costs less.
CACHE holds NAME.samples.npy ([27, n, y, x], frames.py) and NAME.ref.npy ([3, y, x]), exposed alike, and NAME.exposure.npy
(training/scenes/to_frames.py); it may grow during training.
The learning rate follows the hours spent (of one core), so a run that is interrupted ends with the same schedule.
"""
import argparse
import dataclasses
import json
import math
import sys
import time
from pathlib import Path

import numpy as np
import torch
import torch.nn.functional as F

import export
from augment import augmented, part_shape
from estimator import Network, Shape
from optimizer import Optimizer
from widen import widen

FLOOR, WARM_UP = 1e-5, 200  # learning rate; steps
LONGEST_GRADIENT = 10  # of the logarithm of the loss
AVERAGE = 0.998  # of the weights that are validated and exported: a mean over the latest 500 steps
CHECKPOINT_SECONDS = 180
VALIDATED_COUNTS = (4, 16, 64)  # samples a pixel, as far as the frames have them


def loss_of(result, reference):
    """Relative squared error, bounded; relative error; and, because both favor the darker of two guesses, energy of blocks."""
    square = (result - reference).square() / (reference.square() + 0.01)
    relative = (result - reference).abs() / (result.abs() + reference.abs() + 0.02)
    loss = (square / (1 + square / 2)).mean() + 0.3 * relative.mean()
    for width, share in ((16, 0.25), (64, 0.4)):
        a, b = (F.avg_pool2d(x[None], min(width, *x.shape[1:]))[0] for x in (result, reference))
        loss = loss + share * ((a - b).abs() / (b + 0.05)).mean()
    return loss


def of_equal_weight(loss):
    """Frames are compared by the geometric mean of their errors: to halve a small one is worth as much as to halve a large one."""
    return torch.log(loss + 0.003)


def trimmed_error(result, reference, exposure):
    """relMSE without the worst 0.1 % of the pixels, of the frame as it was before its exposure."""
    error = ((result - reference).square() / (reference.square() + 0.01 * exposure ** 2)).mean(0).flatten().sort().values
    return float(error[:len(error) - len(error) // 1000].mean())


class Frames:
    """A folder of frames, mapped; looked at again now and then because it may grow."""

    def __init__(self, folder):
        self.folder, self.names = Path(folder), []
        self.refresh()

    def refresh(self):
        self.names = sorted(p.name[:-len(".samples.npy")] for p in self.folder.glob("*.samples.npy"))

    def load(self, name):
        """Mapped: a step reads of it what it sees."""
        return tuple(torch.from_numpy(np.load(self.folder / f"{name}.{kind}.npy", mmap_mode="c")) for kind in ("samples", "ref"))

    def exposure(self, name):
        file = self.folder / f"{name}.exposure.npy"
        if not file.exists():
            raise SystemExit(f"{file} is missing: {self.folder} was made by an earlier to_frames.py; make it anew from the scenes")
        return float(np.load(file))


class Run:
    def __init__(self, args):
        self.args, self.folder = args, Path(args.run)
        self.folder.mkdir(parents=True, exist_ok=True)
        torch.manual_seed(args.seed)
        self.network = Network(Shape(args.channels, args.sample_features, args.embedding, args.dilations, args.albedo_dilations))
        if args.start:
            widen(export.any_network(args.start), self.network)
        self.network.do_without(args.without)
        self.average = {k: v.clone() for k, v in self.network.state_dict().items()}
        self.optimizer = Optimizer(self.network)
        self.step, self.seconds, self.recent = 0, 0.0, []
        self.rng = np.random.default_rng(args.seed)
        if (self.folder / "checkpoint.pt").exists():
            self.restore(torch.load(self.folder / "checkpoint.pt", weights_only=False))

    def restore(self, state):
        self.network.load_state_dict(state["network"])
        self.optimizer.load_state_dict(state["optimizer"])
        self.average, self.step, self.seconds = state["average"], state["step"], state["seconds"]
        self.rng.bit_generator.state = state["rng"]
        torch.set_rng_state(state["torch_rng"])

    def save(self):
        state = dict(network=self.network.state_dict(), optimizer=self.optimizer.state_dict(), average=self.average, step=self.step,
                     seconds=self.seconds, rng=self.rng.bit_generator.state, torch_rng=torch.get_rng_state(),
                     shape=dataclasses.asdict(self.network.shape), seed=self.args.seed, torch=torch.__version__)
        torch.save(state, self.folder / "checkpoint.tmp")
        (self.folder / "checkpoint.tmp").replace(self.folder / "checkpoint.pt")

    def rate(self):
        progress = min(self.seconds / (self.args.hours * 3600), 1)
        return max(FLOOR, self.args.rate * 0.5 * (1 + math.cos(math.pi * progress))) * min(1, (self.step + 1) / WARM_UP)

    def train_step(self, frames):
        samples, reference = frames.load(frames.names[int(self.rng.integers(len(frames.names)))])
        samples, reference, has_albedo = augmented(samples, reference, self.rng)
        for group in self.optimizer.param_groups:
            group["lr"] = self.rate()
        loss = loss_of(self.network(samples, has_albedo), reference)
        self.optimizer.zero_grad(set_to_none=True)
        of_equal_weight(loss).backward()
        norm = torch.nn.utils.clip_grad_norm_(self.network.parameters(), LONGEST_GRADIENT)
        if torch.isfinite(norm):
            self.optimizer.step()
            self.network.do_without(self.args.without)
            decay = min(AVERAGE, self.step / (self.step + 10))
            for k, v in self.network.state_dict().items():
                self.average[k].lerp_(v, 1 - decay)
        self.step += 1
        self.recent.append(float(loss.detach()))

    @torch.no_grad()
    def validate(self, frames):
        """{samples a pixel: geometric mean of the frames' errors}"""
        network = Network(self.network.shape)
        network.load_state_dict(self.average)
        errors = {}
        for name in frames.names:
            samples, reference = frames.load(name)
            exposure = frames.exposure(name)
            for count in (c for c in VALIDATED_COUNTS if c <= samples.shape[1]):
                height, width = part_shape(*reference.shape[1:], count)
                result = network(samples[:, :count, :height, :width].float())
                errors.setdefault(count, []).append(trimmed_error(result, reference[:, :height, :width], exposure))
        return {count: float(np.exp(np.mean(np.log(e)))) for count, e in errors.items()}

    def log(self, validation, frames):
        line = dict(step=self.step, hours=round(self.seconds / 3600, 4), frames=len(frames.names), rate=self.rate(),
                    loss=float(np.mean(self.recent)), validation=validation, time=time.strftime("%H:%M:%S"))
        self.recent = []
        with open(self.folder / "log.jsonl", "a") as file:
            file.write(json.dumps(line) + "\n")
        print(json.dumps(line), flush=True)

    def go(self):
        frames, validation = Frames(self.args.frames), Frames(self.args.validation)
        for folder in (frames, validation):
            if not folder.names:
                raise SystemExit(f"{folder.folder} has no frames; make them with training/scenes/to_frames.py")
        for name in validation.names:
            validation.exposure(name)
        saved = time.monotonic()
        while self.seconds < self.args.hours * 3600:
            start = time.process_time()
            self.train_step(frames)
            self.seconds += time.process_time() - start
            if time.monotonic() - saved > CHECKPOINT_SECONDS or self.seconds >= self.args.hours * 3600:
                self.save()
                self.log(self.validate(validation), frames)
                frames.refresh()
                saved = time.monotonic()


def numbers(text):
    return tuple(int(number) for number in text.split(",") if number)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--run", required=True)
    parser.add_argument("--frames", required=True)
    parser.add_argument("--validation", required=True)
    parser.add_argument("--hours", type=float, required=True)
    parser.add_argument("--channels", type=numbers, default=(16, 24, 32, 48))
    parser.add_argument("--sample-features", type=int, default=8)
    parser.add_argument("--embedding", type=int, default=Shape.embedding)
    parser.add_argument("--dilations", type=numbers, default=Shape.dilations)
    parser.add_argument("--albedo-dilations", type=numbers, default=Shape.albedo_dilations)
    parser.add_argument("--without", type=lambda text: text.split(","), default=())
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--start")
    parser.add_argument("--rate", type=float, default=1e-3)
    parser.add_argument("--threads", type=int, default=1)
    args = parser.parse_args()
    torch.set_num_threads(args.threads)
    Run(args).go()


if __name__ == "__main__":
    sys.exit(main())
