"""The learned estimator of docs/network.md in PyTorch: inputs, network, sums. Shapes are [channel, sample, y, x] for samples
and [channel, y, x] for pixels; one frame at a time."""
import math
from dataclasses import dataclass
from pathlib import Path

import torch
import torch.nn.functional as F
from torch.utils.cpp_extension import load

# Channels of a frame's samples, as frames.py stores them: what the renderer recorded, normalized by the facts of the frame.
SAMPLE = dict(color=slice(0, 3), normal=slice(3, 6), albedo=slice(6, 9), position=slice(9, 12), hit=slice(12, 13),
              normal2=slice(13, 16), distance2=slice(16, 17), hit2=slice(17, 18), lens=slice(18, 20), time=slice(20, 21),
              film=slice(21, 23), light=slice(23, 25), bsdf=slice(25, 27))
SAMPLE_CHANNELS = 27
INPUTS = 30
# Inputs from 16 on by what a network can do without; passes are guided by those before.
SPARED = dict(second=slice(16, 21), lens=slice(21, 23), time=slice(23, 24), film=slice(24, 26), light=slice(26, 28), bsdf=slice(28, 30))
CONTEXT, BANDWIDTHS = 8, 10
STATISTICS = 18
ALBEDO_FLOOR = 0.05


@dataclass(frozen=True)
class Shape:
    """What a network file says of a network beside its weights."""
    channels: tuple  # of each level
    sample_features: int
    embedding: int = 8  # values of a pass
    dilations: tuple = (8, 4, 2, 1)  # of the passes of the color, then of the albedo
    albedo_dilations: tuple = (2, 1)

    @property
    def pass_values(self):
        return self.embedding + 1 + BANDWIDTHS

    @property
    def head_groups(self):
        """Outputs of the head."""
        return [CONTEXT, 1] + [self.pass_values] * (len(self.dilations) + len(self.albedo_dilations))

_pass = load("rpf_weighted_pass", [str(Path(__file__).with_name("weighted_pass.cpp"))],
             extra_cflags=["-O3", "-march=native", "-ffast-math", "-fopenmp"])


class WeightedPass(torch.autograd.Function):
    """Weighted means over 5x5 pixels at a dilation (weighted_pass.cpp)."""

    @staticmethod
    def forward(ctx, embedding, own, values, dilation):
        embedding, own, values = embedding.contiguous(), own.contiguous(), values.contiguous()
        means, total = _pass.forward(embedding, own, values, dilation)
        ctx.save_for_backward(embedding, own, values, means, total)
        ctx.dilation = dilation
        return means

    @staticmethod
    def backward(ctx, grad):
        embedding, own, values, means, total = ctx.saved_tensors
        a = (grad / total).contiguous()
        b = (a * means).sum(0).contiguous()
        return (*_pass.backward(embedding, own, values, a, b, ctx.dilation), None)


def log1p4(x):
    return torch.log1p(4 * x.clamp(min=0)) / 2


def albedo_base(samples, has_albedo):
    """a of docs/network.md: what radiance is divided by, [3, n, y, x]."""
    hit = samples[SAMPLE["hit"]]
    return torch.where(hit > 0, samples[SAMPLE["albedo"]] + ALBEDO_FLOOR, 1.0) if has_albedo else torch.ones_like(samples[:3])


def sample_inputs(samples, base):
    """The 30 inputs of every sample."""
    part = lambda name: samples[SAMPLE[name]]
    color = part("color").clamp(min=0)
    miss = 1 - part("hit")
    radiance = torch.cat([log1p4(color), torch.log1p(2 * color / base) / 2])
    recorded = torch.cat([part("normal"), part("albedo"), part("position"), miss, part("normal2"),
                          torch.log1p(4 * part("distance2")), part("hit2"), part("lens"), part("time"), part("film"), part("light"),
                          part("bsdf")])
    return torch.cat([radiance, without_constants(recorded)])


def without_constants(inputs):
    """An input that comes out the same for every sample of the frame tells nothing, and is 0."""
    varies = (inputs != inputs[:, :1, :1, :1]).flatten(1).any(1)
    return inputs * varies[:, None, None, None]


def variance(x):
    """Over the samples, of [channel, n, y, x]. (torch.var over a middle dimension takes ten times as long.)"""
    return (x - x.mean(1, keepdim=True)).square().mean(1)


def pixel_statistics(samples, inputs):
    """The 18 plain statistics of a pixel."""
    n = samples.shape[1]
    color = samples[SAMPLE["color"]]
    luminance = color.mean(0, keepdim=True)
    q = (variance(luminance) / n).sqrt() / (luminance.mean(1).clamp(min=0) + 0.02)
    deviation = lambda first: variance(inputs[first:first + 3]).sum(0, keepdim=True).sqrt()
    return torch.cat([log1p4(color.mean(1)), q / (1 + q), inputs[6:16].mean(1), deviation(6), deviation(9), deviation(12),
                      torch.full_like(q, 1 / math.sqrt(n))])


class Network(torch.nn.Module):
    """All layers, named as in docs/network.md."""

    def __init__(self, shape):
        super().__init__()
        self.shape = shape
        s, c, top = shape.sample_features, shape.channels, len(shape.channels) - 1
        layers = {"sample1": (INPUTS, s, 1), "sample2": (s, s, 1), "enter": (2 * s + STATISTICS, c[0], 1), "down0": (c[0], c[0], 3)}
        for l in range(1, top + 1):
            layers[f"down{l}a"], layers[f"down{l}b"] = (c[l - 1], c[l], 3), (c[l], c[l], 3)
        for l in range(top - 1, -1, -1):
            layers[f"up{l}a"], layers[f"up{l}b"] = (c[l + 1] + c[l], c[l], 3), (c[l], c[l], 3)
        layers["head"] = (c[0], sum(shape.head_groups), 1)
        layers["weight1"], layers["weight2"] = (s + CONTEXT, 16, 1), (16, 1, 1)
        self.layers = torch.nn.ModuleDict({name: torch.nn.Conv2d(i, o, k) for name, (i, o, k) in layers.items()})
        self.initialize()

    def initialize(self):
        for name, layer in self.layers.items():
            torch.nn.init.kaiming_normal_(layer.weight, a=0.1)
            torch.nn.init.zeros_(layer.bias)
        with torch.no_grad():  # starts as a moderate filter guided by the features
            self.layers["head"].weight.mul_(0.3)
            for bias in self.layers["head"].bias.split(self.shape.head_groups)[2:]:
                bias[-BANDWIDTHS:] = 0.5
            self.layers["weight2"].weight.mul_(0.1)

    @torch.no_grad()
    def do_without(self, groups):
        """Inputs of SPARED without any weight: rpf does not even read them."""
        for group in groups:
            self.layers["sample1"].weight[:, SPARED[group]] = 0

    def layer(self, name, x, activate=True):
        """x: [channel, ...]; dense layers see every position by itself."""
        conv = self.layers[name]
        if conv.kernel_size[0] == 3:
            y = F.conv2d(F.pad(x[None], (1, 1, 1, 1), mode="replicate"), conv.weight, conv.bias)[0]
        else:
            y = torch.addmm(conv.bias[:, None], conv.weight[:, :, 0, 0], x.flatten(1)).reshape(-1, *x.shape[1:])
        return F.leaky_relu(y, 0.1) if activate else y

    def unet(self, x):
        top = len(self.shape.channels) - 1
        skips = [self.layer("down0", self.layer("enter", x))]
        for l in range(1, top + 1):
            x = halve(skips[-1])
            skips.append(self.layer(f"down{l}b", self.layer(f"down{l}a", x)))
        x = skips[top]
        for l in range(top - 1, -1, -1):
            x = self.layer(f"up{l}b", self.layer(f"up{l}a", torch.cat([double(x, skips[l].shape), skips[l]])))
        return x

    def forward(self, samples, has_albedo=True):
        """samples [27, n, y, x] -> result [3, y, x]"""
        base = albedo_base(samples, has_albedo)
        inputs = sample_inputs(samples, base)
        h = self.layer("sample2", self.layer("sample1", inputs))
        statistics = pixel_statistics(samples, inputs)
        x = torch.cat([h.mean(1), (variance(h) + 1e-4).sqrt(), statistics])
        head = self.layer("head", self.unet(x), activate=False)
        context, blend, *pass_values = head.split(self.shape.head_groups)
        context = context[:, None].expand(-1, h.shape[1], -1, -1)
        logits = self.layer("weight2", self.layer("weight1", torch.cat([h, context])), activate=False)
        weight = logits.clamp(-8, 8).exp()
        sums = torch.cat([weight * samples[:3], weight * base, weight]).sum(1)
        features = statistics[4:14]
        dilations, albedo_dilations = self.shape.dilations, self.shape.albedo_dilations
        sums = weighted_passes(pass_values, features, sums, dilations)
        plain = sums[:3] / sums[6:7]
        if not has_albedo:
            return plain
        albedo = weighted_passes(pass_values[len(dilations):], features, base.mean(1), albedo_dilations)
        return plain + torch.sigmoid(blend.clamp(-20, 20)) * (sums[:3] / sums[3:6] * albedo - plain)


def weighted_passes(pass_values, features, values, dilations):
    """One pass for each dilation, with the head's values for it."""
    for head, dilation in zip(pass_values, dilations):
        embedding, own, bandwidth = head.split([len(head) - 1 - BANDWIDTHS, 1, BANDWIDTHS])
        axes = torch.cat([embedding.clamp(-1000, 1000), bandwidth.clamp(-6, 6).exp() * features])
        values = WeightedPass.apply(axes, own[0].clamp(-8, 8).exp(), values, dilation)
    return values


def halve(x):
    """2x2 means, over the cells that exist."""
    return F.avg_pool2d(x[None], 2, ceil_mode=True, count_include_pad=False)[0]


def double(x, shape):
    """Repetition to the size of the finer level."""
    return F.interpolate(x[None], scale_factor=2, mode="nearest")[0][:, :shape[1], :shape[2]]
