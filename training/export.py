"""Writes a checkpoint's network as the file that `rpf --model` reads (docs/network.md, "File").

Usage: export.py CHECKPOINT OUT.rpfnet --name NAME [--note TEXT] [--start NETWORK.rpfnet --share 0.6] [--without film,light,bsdf]
--start: the network that training went on from, or that it widened; of its way from there this share is taken, which errs less on new
frames than either end. --without: as train.py has it, where a network hardly misses these inputs.
"""
import argparse
import dataclasses
import json

import numpy as np
import torch

from estimator import Network, Shape
from widen import widen


def layer_values(layer):
    """Weights as [ky][kx][in][out], then the bias, as binary16; 0 never has a sign."""
    weights = layer.weight.detach().permute(2, 3, 1, 0).flatten()
    return np.concatenate([weights.numpy(), layer.bias.detach().numpy()]).astype("<f2") + np.float16(0)


def write(network, path, name, note):
    header = dict(format="rpf-network", version=2, name=name, **dataclasses.asdict(network.shape), training=note)
    with open(path, "wb") as file:
        file.write(json.dumps(header).encode() + b"\n")
        for layer in network.layers.values():
            layer_values(layer).astype("<f2").tofile(file)


def shape_of(header):
    """Of the header of a file, or of what a checkpoint says. Files of version 1 do not say which passes there are: those of a Shape."""
    is_list = lambda name: isinstance(header[name], list)
    known = [field.name for field in dataclasses.fields(Shape) if field.name in header]
    return Shape(**{name: tuple(header[name]) if is_list(name) else header[name] for name in known})


def read(path):
    """The network of such a file."""
    with open(path, "rb") as file:
        header = json.loads(file.readline())
        values = torch.from_numpy(np.frombuffer(file.read(), "<f2").astype(np.float32))
    network = Network(shape_of(header))
    for layer in network.layers.values():
        outputs, inputs, width, _ = layer.weight.shape
        weights, bias, values = values.split([layer.weight.numel(), outputs, len(values) - layer.weight.numel() - outputs])
        layer.weight.data = weights.reshape(width, width, inputs, outputs).permute(3, 2, 0, 1).contiguous()
        layer.bias.data = bias.clone()
    return network


def network_of(state):
    """The network of a checkpoint, with the averaged weights."""
    network = Network(Shape(**state["shape"]))
    network.load_state_dict(state["average"])
    return network


def part_of_the_way(start, end, share, seed):
    """Weights between those of a network and of the one that training made of it, which may be wider: as a run with this seed begins."""
    torch.manual_seed(seed)
    wide = Network(end.shape)
    widen(start, wide)
    first = wide.state_dict()
    end.load_state_dict({name: torch.lerp(first[name], last, share) for name, last in end.state_dict().items()})
    return end


def any_network(path):
    """The network of a checkpoint, or of a file of ours."""
    return read(path) if str(path).endswith(".rpfnet") else network_of(torch.load(path, weights_only=False))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("checkpoint")
    parser.add_argument("out")
    parser.add_argument("--name", required=True)
    parser.add_argument("--note", default="")
    parser.add_argument("--start")
    parser.add_argument("--share", type=float, default=1)
    parser.add_argument("--without", type=lambda text: text.split(","), default=())
    args = parser.parse_args()
    state = torch.load(args.checkpoint, weights_only=False)
    facts = f"seed {state['seed']}, {state['step']} steps, {state['seconds'] / 3600:.2f} hours, PyTorch {state['torch']}"
    network = network_of(state)
    if args.start:
        network = part_of_the_way(any_network(args.start), network, args.share, state["seed"])
        facts += f", {args.share:g} of the way"
    network.do_without(args.without)
    write(network, args.out, args.name, f"{args.note}{'; ' if args.note else ''}{facts}")


if __name__ == "__main__":
    main()
