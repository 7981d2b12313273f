"""Which views and which pictures are worth training on."""
import numpy as np

SMALLEST_SHARE = 0.006     # of the picture: what a shape must fill to count as seen
LEAST_SHAPES = 3
NEAREST = 0.35
# References of 180 samples a pixel have 1/45 of the noise of 4 samples; more where few paths are bright.
LARGEST_REFERENCE_ERROR = 0.01
SMALLEST_RATIO = 15
FORECAST_MARGIN = 2


def view_score(seen):
    """How much there is to see; None for a view without depth, with an emitter that fills it, or too near."""
    if seen.hit.mean() < 0.45:
        return None
    depth = seen.depth[seen.hit]
    _, pixels = np.unique(seen.shape[seen.hit], return_counts=True)
    share = pixels / seen.hit.size
    near, far = np.percentile(depth, [5, 95])
    crowded = np.percentile(depth, 3) < NEAREST or share.max() > 0.8 or seen.emitter.mean() > 0.2
    if crowded or (share > SMALLEST_SHARE).sum() < LEAST_SHAPES:
        return None
    return np.minimum(share, 0.04).sum() / 0.04 + 0.5 * (np.log(far / near) > 0.5) - 1.5 * max(0, share.max() - 0.5)


def _blocks(image, size=8):
    height, width = (n - n % size for n in image.shape)
    return image[:height, :width].reshape(height // size, size, width // size, size).mean((1, 3))


def picture_fault(mean):
    """Why the mean of the samples, [y, x, 3], is no picture; None if it is one."""
    luminance = np.nan_to_num(mean.mean(-1), posinf=0, neginf=0)
    overall, blocks = luminance.mean(), _blocks(luminance)
    if overall <= 0 or np.median(luminance) < 0.004 * overall:
        return "dark"
    if (blocks < 0.02 * np.median(blocks[blocks > 0])).mean() > 0.5:
        return "mostly dark"
    return "flat" if np.log(blocks + 1e-3 * overall).std() < 0.12 else None


def trimmed(errors):
    """Mean without the largest 0.1 %."""
    errors = np.sort(errors.ravel())
    return float(errors[:len(errors) - max(1, len(errors) // 1000)].mean())


def reference_forecast(samples, reference_spp, exposure):
    """Why a reference of that many samples a pixel would be left out, as far as samples can tell; None if it may be good enough."""
    count = int(samples.counts[0])
    color = np.stack([samples.channels[c].reshape(-1, count) for c in "RGB"], -1) * exposure
    expected = trimmed(color.var(1, ddof=1) / (np.square(color.mean(1)) + 0.01)) / reference_spp
    return "noisy" if expected > FORECAST_MARGIN * LARGEST_REFERENCE_ERROR else None


def noise(mean, count, reference, variance, exposure):
    """Relative squared errors at the frame's exposure: of 4 samples, of the reference, and their ratio."""
    scale = np.square(reference * exposure) + 0.01
    of_mean = trimmed(np.square((mean - reference) * exposure) / scale) * int(count) / 4
    of_reference = trimmed(variance * exposure**2 / scale)
    return {"error of 4 samples": of_mean, "error of reference": of_reference, "ratio": of_mean / max(of_reference, 1e-12)}


def noise_fault(facts):
    if facts["error of reference"] > LARGEST_REFERENCE_ERROR:
        return "noisy reference"
    return "reference no better than samples" if facts["ratio"] < SMALLEST_RATIO else None
