"""What a training step sees of a frame: some of its samples, turned, recolored, with groups of channels left out."""
import torch

from estimator import SAMPLE

GROUPS = {"N": ["normal"], "albedo": ["albedo"], "P": ["position"], "second": ["normal2", "distance2", "hit2"], "lens": ["lens"],
          "time": ["time"], "film": ["film"], "numbers": ["light", "bsdf"]}


MOST_VALUES = 8 * 128 * 128  # samples of a step: frames of many samples are cut, so that all steps cost about the same
ALIGNED = 8  # pixels: cells of the coarsest level
OFTEN_REPEATED = 0.1  # of the steps have counts that no scene was rendered with
MOST_REPEATED = 32    # times


def chosen_count(n, rng):
    """1 to all of n samples, 4 most often."""
    powers = [2 ** k for k in range(n.bit_length()) if 2 ** k <= n]
    return 4 if rng.random() < 0.6 else powers[int(rng.integers(len(powers)))]


def part_shape(height, width, count):
    """Of the part of a frame that a step can see with so many samples a pixel."""
    while count * height * width > MOST_VALUES and min(height, width) > 4 * ALIGNED:
        height, width = (height // 2, width) if height >= width else (height, width // 2)
    return height, width


def chosen_samples(samples, reference, rng):
    """Some of the samples, of the frame or of a part of it. [27, n, y, x]"""
    n, *shape = samples.shape[1:]
    count = chosen_count(n, rng)
    times = 2 ** int(rng.integers(1, MOST_REPEATED.bit_length())) if rng.random() < OFTEN_REPEATED else 1
    part = part_shape(*shape, count * times)
    y, x = (int(rng.integers((size - p) // ALIGNED + 1)) * ALIGNED for size, p in zip(shape, part))
    samples, reference = (v[..., y:y + part[0], x:x + part[1]] for v in (samples, reference))
    return repeated(samples[:, torch.from_numpy(rng.permutation(n)[:count].copy())], reference, times)


def repeated(samples, reference, times):
    """Stands for `times` as many samples: their mean comes as much closer to the reference as that of more would, their spread stays."""
    if times > 1:
        samples = samples.float()
        color = samples[SAMPLE["color"]]
        mean = color.mean(1, keepdim=True)
        color += (reference[:, None] - mean) * (1 - times ** -0.5)
        samples = samples.repeat(1, times, 1, 1)
    return samples, reference


def turned(samples, reference, rng):
    """One of eight quarter turns and mirrors; positions in the pixel turn with the picture."""
    film = samples[SAMPLE["film"]]
    if rng.random() < 0.5:
        samples, reference, film = samples.transpose(-1, -2), reference.transpose(-1, -2), film.transpose(-1, -2).flip(0)
    for axis, k in ((-1, 0), (-2, 1)):
        if rng.random() < 0.5:
            samples, reference, film = samples.flip(axis), reference.flip(axis), film.flip(axis)
            film[k] = -film[k]
    samples = samples.contiguous()
    samples[SAMPLE["film"]] = film
    return samples, reference.contiguous()


def recolored(samples, reference, rng):
    """Channels permuted, the light's color and the exposure changed; albedo keeps its values."""
    order = torch.from_numpy(rng.permutation(3).copy())
    tint = torch.from_numpy(2.0 ** rng.uniform(0, 1) * torch.exp(torch.from_numpy(rng.normal(0, 0.15, 3))).numpy()).float() * 0.75
    if rng.random() < 0.25:
        tint = tint * float(2.0 ** rng.normal(0, 0.7))
    for name in ("color", "albedo"):
        samples[SAMPLE[name]] = samples[SAMPLE[name]][order]
    samples[SAMPLE["color"]] *= tint[:, None, None, None]
    return samples, reference[order] * tint[:, None, None]


def world_turned(samples, rng):
    """Another orientation of the world: axes permuted and flipped, or any rotation."""
    if rng.random() < 0.6:
        turn = torch.zeros(3, 3)
        turn[torch.arange(3), torch.from_numpy(rng.permutation(3).copy())] = torch.from_numpy(rng.choice([-1.0, 1.0], 3)).float()
    else:
        turn = torch.linalg.qr(torch.from_numpy(rng.normal(size=(3, 3))).float())[0]
    for name in ("normal", "position", "normal2"):
        samples[SAMPLE[name]] = torch.tensordot(turn, samples[SAMPLE[name]], 1)
    return samples


def without_groups(samples, rng):
    """Leaves groups of channels out: none in most steps, all in a few. -> samples, whether albedo is there"""
    chance = rng.random()
    probability = 0.0 if chance < 0.7 else 1.0 if chance > 0.97 else 0.3
    has_albedo = True
    for group, names in GROUPS.items():
        if rng.random() < probability:
            has_albedo = has_albedo and group != "albedo"
            for name in names:
                samples[SAMPLE[name]] = 0
    for name in ("lens", "time"):  # numbers without meaning: a renderer that records them for a pinhole
        if rng.random() < 0.05:
            part = samples[SAMPLE[name]]
            samples[SAMPLE[name]] = 2 * torch.rand(part.shape) - 1
    return samples, has_albedo


def quieter(samples, reference, rng):
    """Pulls radiance towards the reference: the noise of better samplers or simpler light."""
    if rng.random() < 0.2:
        keep = float(rng.uniform(0.05, 1))
        color = samples[SAMPLE["color"]]
        color += (1 - keep) * (reference[:, None] - color)
    return samples


def noisier(samples, rng):
    """Keeps a sample's radiance with a probability, and divides by it (Russian roulette): noise of worse samplers, of the same mean."""
    if rng.random() < 0.35:
        keep = 2.0 ** -float(rng.uniform(0, 4))
        color = samples[SAMPLE["color"]]
        color *= (torch.rand(1, *color.shape[1:]) < keep) / keep
    return samples


def augmented(samples, reference, rng):
    """[27, n, y, x], [3, y, x] of one frame -> the same for a step, and whether albedo is there."""
    samples, reference = chosen_samples(samples, reference, rng)
    samples, reference = turned(samples.float(), reference.float(), rng)
    samples, reference = recolored(samples, reference, rng)
    samples = noisier(quieter(world_turned(samples, rng), reference, rng), rng)
    samples, has_albedo = without_groups(samples, rng)
    return samples, reference, has_albedo
