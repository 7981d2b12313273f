"""A wider network that computes what a trained one computes: where a larger model starts (Net2Net, Chen et al. 2016)."""
import copy
import math

import torch

from estimator import BANDWIDTHS, CONTEXT, INPUTS, STATISTICS


def input_groups(network):
    """For every layer the sizes of what is concatenated as its input."""
    s, c = network.shape.sample_features, network.shape.channels
    groups = {"sample1": [INPUTS], "sample2": [s], "enter": [s, s, STATISTICS], "down0": [c[0]], "head": [c[0]],
              "weight1": [s, CONTEXT], "weight2": [16]}
    for l in range(1, len(c)):
        groups[f"down{l}a"], groups[f"down{l}b"] = [c[l - 1]], [c[l]]
        groups[f"up{l - 1}a"], groups[f"up{l - 1}b"] = [c[l], c[l - 1]], [c[l - 1]]
    return groups


@torch.no_grad()
def with_turned_embedding(network):
    """The same weights of passes, which see distances only: embeddings turned so that their first values vary most."""
    turned = copy.deepcopy(network)
    head, embedding = turned.layers["head"], network.shape.embedding
    for first in range(CONTEXT + 1, head.out_channels, network.shape.pass_values):
        rows = slice(first, first + embedding)
        turn = torch.linalg.svd(head.weight[rows, :, 0, 0]).U.T
        head.weight[rows, :, 0, 0], head.bias[rows] = turn @ head.weight[rows, :, 0, 0], turn @ head.bias[rows]
    return turned


def nearest(dilations, dilation):
    return min(range(len(dilations)), key=lambda p: abs(math.log(dilations[p] / dilation)))


def head_outputs(old, new):
    """For outputs of the new head: which of the old one they begin as."""
    embedding = min(old.embedding, new.embedding)
    of_pass = [*range(embedding), *range(-1 - BANDWIDTHS, 0)]
    outputs = {i: i for i in range(CONTEXT + 1)}
    place = lambda shape, p, value: CONTEXT + 1 + p * shape.pass_values + value % shape.pass_values
    passes = [nearest(old.dilations, d) for d in new.dilations]
    passes += [len(old.dilations) + nearest(old.albedo_dilations, d) for d in new.albedo_dilations]
    for p, begins_as in enumerate(passes):
        outputs |= {place(new, p, value): place(old, begins_as, value) for value in of_pass}
    return outputs


@torch.no_grad()
def widen(narrow, wide):
    """Writes a network into one of the same depth: added channels have random inputs, and what was there does not read them yet."""
    if wide.shape.embedding < narrow.shape.embedding:
        narrow = with_turned_embedding(narrow)
    old_groups, new_groups = input_groups(narrow), input_groups(wide)
    for name, old in narrow.layers.items():
        new = wide.layers[name]
        begins_as = head_outputs(narrow.shape, wide.shape) if name == "head" else {i: i for i in range(old.out_channels)}
        to, outputs = list(begins_as), list(begins_as.values())
        new.weight[to] = 0
        new.bias[to] = old.bias[outputs]
        at_old = at_new = 0
        for size, new_size in zip(old_groups[name], new_groups[name]):
            new.weight[to, at_new:at_new + size] = old.weight[outputs, at_old:at_old + size]
            at_old, at_new = at_old + size, at_new + new_size
