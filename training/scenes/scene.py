"""From a seed to the samples and the reference of a random scene."""
import gc

import numpy as np

import acceptance
import layouts
import lights
import motion
import objects
import views
from builder import SceneBuilder
from camera import make_camera
from frames import exposure
from rpf.mitsuba import SamplePlanes, render_reference, render_samples

DEPTHS = {2: 0.1, 3: 0.2, 5: 0.4, 7: 0.3}  # 2: direct light only; each has kernels of its own
DEEP = 7
PLAIN_SHARE = 0.12      # of scenes without any texture
LENS_TOO = 0.25         # of scenes with motion
STRATIFIED = "multijitter"


class Rejected(Exception):
    pass


class RandomScene:
    """One attempt at a scene. Everything random comes from seed and attempt."""

    def __init__(self, seed, attempt, options):
        self.rng, self.seed, self.options = np.random.default_rng([seed, attempt]), seed, options
        rng, plain = self.rng, self.rng.random() < PLAIN_SHARE
        kind = str(rng.choice(list(layouts.HOW_OFTEN), p=list(layouts.HOW_OFTEN.values())))
        self.builder = SceneBuilder(rng, plain)
        layout = layouts.build(self.builder, kind)
        placed = objects.place(self.builder, layout)
        lit = lights.light(self.builder, layout, placed)
        depth = int(rng.choice(list(DEPTHS), p=list(DEPTHS.values())))
        if any(m.kind == "glass" for m in self.builder.materials.used()):
            depth = DEEP
        self.scene = self.builder.load(depth)
        self.mode = str(rng.choice(list(views.MODES), p=list(views.MODES.values())))
        stratified = rng.random() < options.stratified_share and self.mode != "object motion"
        self.camera = make_camera(options.size, STRATIFIED if stratified else "independent")
        self.reference_camera = make_camera(options.size, STRATIFIED)
        self.facts = {"layout": kind, "mode": self.mode, "plain": int(plain), "depth": depth, "stratified": int(stratified), **lit}
        self._choose_view(layout, placed)

    def _choose_view(self, layout, placed):
        found = views.find(self.rng, self.scene, self.camera, layout, placed)
        if found is None:
            raise Rejected("no view")
        view, seen = found
        self.moving = []
        self.lens = self.mode == "lens" or ("motion" in self.mode and self.rng.random() < LENS_TOO)
        if self.lens:
            views.open_lens(self.rng, view, seen)
        if self.mode == "camera motion":
            views.move_camera(self.rng, view, seen)
        elif self.mode == "object motion":
            self.moving = views.move_objects(self.rng, view, placed)
        self.camera.look(view)
        self.reference_camera.look(view)
        self.facts.update(lens=float(view.aperture), motion=float(np.linalg.norm(view.velocity)) or
                          float(max((np.linalg.norm(velocity) for _, velocity, _ in self.moving), default=0)))

    def render(self):
        """-> SamplePlanes, reference [y, x, 3]"""
        options = self.options
        moving = motion.MovingObjects(self.scene, self.builder.meshes, self.moving)
        if self.moving:
            samples = motion.render_samples(self.scene, self.camera, moving, options.spp, self.seed)
        else:
            samples = render_samples(self.scene, options.spp, self.seed, self.camera, moving=self.mode == "camera motion")
        if not self.lens:
            samples.channels = {name: v for name, v in samples.channels.items() if not name.startswith("random.lens")}
        self._judge(acceptance.picture_fault(samples.mean()))
        self._judge(acceptance.reference_forecast(samples, options.reference_spp, self._exposure(samples)))
        reference_seed = (self.seed * 64 + 1_000_003) & 0x3FFFFFFF
        if self.moving:
            reference = motion.render_reference(self.scene, self.reference_camera, moving, options.reference_spp, reference_seed)
        else:
            reference = render_reference(self.scene, options.reference_spp, reference_seed, self.reference_camera)
        noise = acceptance.noise(samples.mean(), samples.counts[0], *reference, self._exposure(samples))
        self._judge(acceptance.noise_fault(noise))
        samples.metadata |= {f"scene:{k}": v for k, v in {**self.facts, **noise}.items()}
        return samples, reference[0]

    def _exposure(self, samples):
        _, _, width, height = samples.window
        color = np.stack([samples.channels[c].reshape(height, width, -1).transpose(2, 0, 1) for c in "RGB"], -1)
        return exposure(np.nan_to_num(color, posinf=0, neginf=0))

    @staticmethod
    def _judge(fault):
        if fault:
            raise Rejected(fault)


def as_samples(image):
    """A picture as one sample in the middle of each pixel."""
    height, width = image.shape[:2]
    y, x = np.mgrid[:height, :width] + 0.5
    channels = {name: np.float32(plane).ravel() for name, plane in zip("RGB", np.moveaxis(image, -1, 0))}
    return SamplePlanes((0, 0, width, height), np.ones(width * height, np.uint32), channels | {"film.X": x.ravel(), "film.Y": y.ravel()})


def make_scene(seed, options, attempts):
    """-> samples, reference, both SamplePlanes. Raises RuntimeError if no attempt gives a good picture."""
    faults = []
    for attempt in range(attempts):
        made = None
        gc.collect()  # BSDFs that are alive are part of every kernel
        try:
            made = RandomScene(seed, attempt, options)
            samples, reference = made.render()
        except Rejected as fault:
            faults.append(str(fault))
            continue
        samples.metadata["scene:attempt"] = attempt
        return samples, as_samples(reference)
    raise RuntimeError(f"no good picture in {attempts} attempts: {', '.join(sorted(set(faults)))}")
