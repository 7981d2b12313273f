"""A wider network that computes what a trained one computes: where a larger model starts (Net2Net, Chen et al. 2016)."""
import torch

from estimator import CONTEXT, INPUTS, STATISTICS


def input_groups(network):
    """For every layer the sizes of what is concatenated as its input."""
    s, c = network.sample_features, network.channels
    groups = {"sample1": [INPUTS], "sample2": [s], "enter": [s, s, STATISTICS], "down0": [c[0]], "head": [c[0]],
              "weight1": [s, CONTEXT], "weight2": [16]}
    for l in range(1, len(c)):
        groups[f"down{l}a"], groups[f"down{l}b"] = [c[l - 1]], [c[l]]
        groups[f"up{l - 1}a"], groups[f"up{l - 1}b"] = [c[l], c[l - 1]], [c[l - 1]]
    return groups


@torch.no_grad()
def widen(narrow, wide):
    """Writes a network into one of the same depth: added channels have random inputs, and what was there does not read them yet."""
    old_groups, new_groups = input_groups(narrow), input_groups(wide)
    for name, old in narrow.layers.items():
        new, outputs = wide.layers[name], old.out_channels
        new.weight[:outputs] = 0
        new.bias[:outputs] = old.bias
        at_old = at_new = 0
        for size, new_size in zip(old_groups[name], new_groups[name]):
            new.weight[:outputs, at_new:at_new + size] = old.weight[:, at_old:at_old + size]
            at_old, at_new = at_old + size, at_new + new_size
