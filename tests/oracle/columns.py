"""The third witness of section 12, columns of pixels in the space of the samples, in double precision, from its text."""
import numpy as np

import light_field
import scene_frame
from report import Report
from tolerances import TOLERANCE

LENSES, LEAF, PLANE, TENSOR, LEAST, ROUND, MOST_LEAVES = 15, 4, 32, 8, 1e-9, 0.01, 64


def lens_of(case):
    """What lens and time are worth on the film, as float32 has it."""
    return np.float32(max(case["width"], case["height"])) / np.float32(LENSES)


def space(case):
    """(12.1): [S, 5], and which of the dimensions there are [5]."""
    columns = [scene_frame.channel(case, "film.X"), scene_frame.channel(case, "film.Y")]
    there = [True, True]
    for name in ("random.lens.U", "random.lens.V", "random.time"):
        values = scene_frame.channel(case, name) if name in case["channels"] else np.zeros(len(columns[0]))
        there.append(not scene_frame.is_constant(values))
        columns.append((lens_of(case) * values.astype(np.float32)).astype(float) if there[-1] else 0 * columns[0])
    return np.stack(columns, axis=1), np.array(there)


class Tree:
    """(12.2): nodes by number, leaves from `leaves` on."""

    def __init__(self, places, samples):
        self.places, self.leaves = places, 1
        while len(samples) > LEAF * self.leaves:
            self.leaves *= 2
        self.axis, self.split, self.held = {}, {}, {}
        self.divide(1, samples)

    def divide(self, node, samples):
        if node >= self.leaves:
            self.held[node - self.leaves] = samples
            return
        axis = int(np.argmax(np.ptp(self.places[samples], axis=0)))
        samples = samples[np.lexsort((samples, self.places[samples, axis]))]
        middle = len(samples) // 2
        self.axis[node], self.split[node] = axis, self.places[samples[middle], axis]
        self.divide(2 * node, samples[:middle])
        self.divide(2 * node + 1, samples[middle:])


class Space:
    """The samples that take part, and what is far at each leaf."""

    def __init__(self, case, values):
        places, self.there = space(case)
        counts = scene_frame.channel(case, "weight") > 0 if "weight" in case["channels"] else np.ones(len(places), dtype=bool)
        self.samples = np.flatnonzero(counts & np.isfinite(places).all(axis=1))
        self.places, self.colors = places, values[:, :3] / np.abs(values[:, :3]).max()
        self.tree = Tree(places, self.samples)
        self.leaf_of = {int(s): leaf for leaf, held in self.tree.held.items() for s in held}
        tensors = {leaf: self.tensor(leaf) for leaf in self.tree.held}
        self.metrics = {leaf: self.metric(sum(tensors[self.leaf_of[int(s)]] for s in self.around(leaf, TENSOR))) for leaf in self.tree.held}

    def around(self, leaf, count):
        """The samples nearest to the middle of a leaf."""
        distance = ((self.places[self.samples] - self.places[self.tree.held[leaf]].mean(axis=0)) ** 2).sum(axis=1)
        return self.samples[np.lexsort((self.samples, distance))[:count]]

    def tensor(self, leaf):
        """(12.3)."""
        near = self.around(leaf, PLANE)
        off = self.places[near] - self.places[near].mean(axis=0)
        spread = off.T @ off
        if np.trace(spread) == 0:
            return np.zeros((5, 5))
        spread += LEAST * np.trace(spread) * np.eye(5)
        gradients = np.linalg.solve(spread, off.T @ (self.colors[near] - self.colors[near].mean(axis=0)))
        return gradients @ gradients.T

    @staticmethod
    def metric(tensor):
        """(12.4)."""
        return (tensor / np.trace(tensor) if np.trace(tensor) > 0 else 0 * tensor) + ROUND * np.eye(5)

    def nearest(self, at):
        """(12.5): the sample that a point takes, and whether rounding may take another one."""
        tree, node, close = self.tree, 1, False
        while node < tree.leaves:
            off = at[tree.axis[node]] - tree.split[node]
            close |= abs(off) < TOLERANCE["light_near"]
            node = 2 * node + (off >= 0)
        metric = self.metrics[node - tree.leaves]
        off = self.places - at
        distance = np.einsum("si,ij,sj->s", off, metric, off)
        steep = 1 / np.diag(np.linalg.inv(metric))
        waiting, best, looked, seen = [(1, 0.0)], None, 0, []
        while waiting and looked < MOST_LEAVES:
            node, least = waiting.pop()
            if best is not None and least > distance[best]:
                continue
            while node < tree.leaves:
                off = at[tree.axis[node]] - tree.split[node]
                waiting.append((2 * node + (off < 0), max(least, off * off * steep[tree.axis[node]])))
                node = 2 * node + (off >= 0)
            looked += 1
            for sample in tree.held[node - tree.leaves]:
                seen.append(distance[sample])
                if best is None or (distance[sample], sample) < (distance[best], best):
                    best = int(sample)
        first, second = np.sort(seen)[:2] if len(seen) > 1 else (0.0, 1.0)
        return best, bool(close or second - first < TOLERANCE["column_near"] * second)


def integrate(case, frame):
    """Sums [pixels, 3] over the points, their number, and of each pixel the part that rounding may change."""
    values = Space(case, frame.values)
    lens = float(lens_of(case))
    points = light_field.sequence(case["settings"]["views"])[:, [0, 1, 3, 4, 2]] * np.where(values.there, [1, 1, lens, lens, lens], 0)
    sums, close = np.zeros((len(frame.counts), 3)), np.zeros(len(frame.counts))
    for pixel in range(len(frame.counts)):
        for point in points.astype(np.float32).astype(float):
            sample, is_close = values.nearest(point + [pixel % frame.width, pixel // frame.width, 0, 0, 0])
            sums[pixel] += frame.values[sample, :3]
            close[pixel] += is_close
    return sums, np.full(len(frame.counts), float(len(points))), close / len(points)


def compare(case, trace):
    """The Report on a trace of a case."""
    frame = scene_frame.load_frame(case, [], [])
    report = Report()
    light_field.check_image(frame, *integrate(case, frame), trace["image"], report)
    return report
