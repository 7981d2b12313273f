"""The third witness of section 11, the light field, in double precision, from its text."""
import numpy as np

import scene_frame
from report import Report
from tolerances import TOLERANCE

EMPTY_CIRCLE, WIDEST, MOST_SEEN, LEAST_TIME, LEAST_NEARNESS = 2.4, 8.0, 32, 1 / 1024, 1e-6
CLOSE_BY = 128 ** -0.5


def sequence(count):
    """[count, 5]: points of the additive recurrence."""
    root = 1.0
    for _ in range(100):
        root = (root + 1) ** (1 / 6)                              # of x^6 = x + 1
    return (0.5 + np.outer(np.arange(1, count + 1), root ** -np.arange(1.0, 6.0))) % 1


def views(count):
    """[count, 5]: u, v of the lens, time, x, y."""
    x, y, time, a, b = sequence(count).T
    a, b = 2 * a - 1, 2 * b - 1
    wide = np.abs(a) > np.abs(b)
    radius, other = np.where(wide, a, b), np.where(wide, b, a)
    angle = np.pi / 4 * other / np.where(radius == 0, 1, radius)
    u = radius * np.where(wide, np.cos(angle), np.sin(angle))
    v = radius * np.where(wide, np.sin(angle), np.cos(angle))
    return np.stack([u, v, time, x, y], axis=1)


class Camera:
    """(11.2): where positions are seen on the film, and how far in inverse distance from what is sharp."""

    def __init__(self, case):
        about = case["metadata"]
        self.to_camera = np.reshape(about["worldToCamera"], (4, 4)).astype(float)
        self.to_ndc = np.reshape(about["worldToNDC"], (4, 4)).astype(float)
        self.size = np.array([case["width"], case["height"]])
        self.focus = about["rpf:focusDistance"]
        self.right, self.up = (about["rpf:lensRadius"] * self.seen_from(np.linalg.inv(self.to_camera)[axis, :3]) for axis in (0, 1))

    def film(self, positions):
        """[S, 2] through the lens's center."""
        seen = np.concatenate([positions, np.ones((len(positions), 1))], axis=1) @ self.to_ndc
        return seen[:, :2] / seen[:, 3:] * self.size

    def seen_from(self, way):
        """How far on the film what is 1 before the camera moves by this way, pixels."""
        middle = (np.array([0, 0, 1, 1]) @ np.linalg.inv(self.to_camera))[:3]
        return np.subtract(*self.film(np.stack([middle + way, middle])))

    def depth(self, positions):
        return positions @ self.to_camera[:3, 2] + self.to_camera[3, 2]


class Samples:
    """The samples of a case as (11.1) has them move."""

    def __init__(self, case):
        def group(name):
            return np.stack([scene_frame.channel(case, f"feature.{name}.{axis}") for axis in "XYZ"], axis=1)
        self.camera = Camera(case)
        self.position = group("P")
        self.far = np.isnan(self.position).any(axis=1)
        self.own = np.stack([scene_frame.channel(case, "film.X"), scene_frame.channel(case, "film.Y")], axis=1)
        self.time = scene_frame.channel(case, "random.time")[:, None]
        self.opening, self.closing = group("opening"), group("closing")
        weight = scene_frame.channel(case, "weight") if "weight" in case["channels"] else np.ones(len(self.far))
        self.counts = weight > 0

    def at(self, time):
        """[S, 3]: each coordinate on the parabola through its three places."""
        around = self.time * (self.time - 1)
        off = self.position - self.opening - self.time * (self.closing - self.opening)
        bends = -around >= LEAST_TIME
        line = self.position + (time - self.time) * (self.closing - self.opening)
        parabola = self.opening + time * (self.closing - self.opening) + time * (time - 1) * off / np.where(bends, around, 1)
        moved = np.where(bends, parabola, line)
        return np.where(np.isnan(moved), self.position, moved)

    def seen(self, u, v, time):
        """x, y [S, 2], depth [S], shift [S]."""
        there = np.where(self.far[:, None], 1.0, self.at(time))
        depth = np.where(self.far, np.inf, self.camera.depth(there))
        shift = 1 / depth - 1 / self.camera.focus
        film = self.camera.film(there) - (u * self.camera.right + v * self.camera.up) * shift[:, None]
        return np.where(self.far[:, None], self.own, film), depth, shift


def near(values):
    """Whether one of the values is so near to 0 that float32 may take it for the other side."""
    return bool((np.abs(values) < TOLERANCE["light_near"]).any())


class Place:
    """What is seen at a place of the film in a view; `close`: rounding may see something else."""

    def __init__(self, at, film, depth, ends, camera, reach):
        offset = film - at
        distance = np.linalg.norm(offset, axis=1)
        around = np.flatnonzero((distance <= reach + 0.01) & (depth > 0))
        self.close = near(distance[around] - reach)
        around = around[distance[around] <= reach]
        around = around[np.lexsort((around, distance[around]))]
        self.close |= len(around) > MOST_SEEN and near(distance[around[MOST_SEEN]] - distance[around[MOST_SEEN - 1]])
        around = around[:MOST_SEEN]
        with np.errstate(invalid="ignore"):
            self.order = around[np.lexsort((around, depth[around]))]
            self.close |= near(np.nan_to_num(np.diff(depth[self.order]) / depth[self.order][:-1], nan=1.0, posinf=1.0))
        self.offset, self.distance, self.ends, self.camera, self.reach = offset, distance, ends, camera, reach

    def crosses(self, a, b):
        """(11.4)."""
        apart = self.offset[b] - self.offset[a]
        lens = CLOSE_BY * np.hypot(self.camera.right @ apart, self.camera.up @ apart)
        for film, shift in self.ends:
            left = (film[b] - film[a]) @ apart - abs(shift[b] - shift[a]) * lens
            self.close |= near(left) and not (left == 0).all()
            if left < 0:
                return True
        return False

    def covers(self, surface):
        """(11.5)."""
        x, y = self.offset[surface].T
        side = np.outer(x, y) - np.outer(y, x)
        self.close |= near(side[~np.eye(len(surface), dtype=bool)])
        return len(surface) > 2 and bool((side < 0).any(axis=1).all())

    def surface(self):
        """The samples of the surface that is seen, and their shares of (11.6)."""
        surface = list(self.order[:1])
        for sample in self.order[1:]:
            if not any(self.crosses(one, sample) for one in surface):
                surface.append(sample)
                continue
            if self.covers(surface):
                break
            surface = [sample]
        nearness = np.maximum(1 - self.distance[surface] / self.reach, LEAST_NEARNESS)
        return surface, nearness / nearness.sum()


def see(case, frame):
    """The picture [pixels, 3], and of each pixel the part of its views that rounding may change."""
    samples, count = Samples(case), case["settings"]["views"]
    reach = min(EMPTY_CIRCLE / np.sqrt(frame.counts.sum() / len(frame.counts)), WIDEST)
    sums, seen, close = np.zeros((len(frame.counts), 3)), np.zeros(len(frame.counts)), np.zeros(len(frame.counts))
    for u, v, time, x, y in views(count):
        film, depth, _ = samples.seen(u, v, time)
        ends = [samples.seen(u, v, time + step * CLOSE_BY)[::2] for step in (-0.5, 0.5)]
        depth = np.where(samples.counts, depth, -1.0)
        for pixel in range(len(frame.counts)):
            place = Place(np.array([pixel % frame.width + x, pixel // frame.width + y]), film, depth, ends, samples.camera, reach)
            surface, share = place.surface()
            close[pixel] += place.close
            if surface:
                sums[pixel] += share @ frame.values[surface, :3]
                seen[pixel] += 1
    return sums, seen, close / count


def check_image(frame, sums, seen, close, image, report):
    """Compares a picture with the mean of what views see, but for the part of them that is close."""
    weight = np.ones(len(frame.values)) if frame.weight is None else frame.weight
    expected = np.zeros((len(frame.counts), 3))
    for pixel in np.flatnonzero(frame.counts):                                                           # (11.7)
        own = frame.own(pixel)
        share = weight[own] if weight[own].sum() > 0 else np.ones(len(own))
        expected[pixel] = sums[pixel] / seen[pixel] if seen[pixel] else share @ frame.values[own, :3] / share.sum()
    largest = np.abs(frame.values[:, :3]).max()
    bound = (TOLERANCE["light_color"] + 2 * close[:, None]) * largest
    report.check("image", image, expected, np.broadcast_to(bound, expected.shape), "image")
    if close.mean() > TOLERANCE["light_close"]:
        report.fail("image", "image", f"{close.mean():.3g} of the views are close calls")


def compare(case, trace):
    """The Report on a trace of a case."""
    frame = scene_frame.load_frame(case, [], [])
    report = Report()
    check_image(frame, *see(case, frame), trace["image"], report)
    return report
