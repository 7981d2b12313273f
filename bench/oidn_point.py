"""Open Image Denoise on the plain mean of a raw sample file. Needs numpy and pyoidn (PyPI), nothing of this project's.

Usage: oidn_point.py IN.rpf OUT.rpf OUT-PREFILTERED.rpf ROUNDS
Writes the denoised images as files of one sample a pixel and prints the seconds of each round as JSON. The first runs are
not counted: they load the library and the weights. Prefiltered: normals and albedo are denoised first, each on its own.
"""
import json
import sys
import time

import numpy as np
import pyoidn

from raw_samples import read_samples, write_samples


def mean_image(file, names):
    """[height][width][3]: the plain mean of these channels, what is missing counts as 0; None where the file has none."""
    header, counts, channels = file
    if not all(name in channels for name in names):
        return None
    pixel = np.repeat(np.arange(len(counts)), counts)
    planes = [np.bincount(pixel, np.nan_to_num(channels[name].astype(np.float64)), len(counts)) for name in names]
    mean = np.stack(planes, -1) / np.maximum(counts, 1)[:, None]
    width, height = header["dataWindow"][2:]
    return np.ascontiguousarray(mean.reshape(height, width, 3), np.float32)


def prefiltered(device, name, image):
    """A feature image without its noise, as Open Image Denoise's documentation advises."""
    result = np.zeros_like(image)
    feature = pyoidn.Filter(device, pyoidn.OIDN_FILTER_TYPE_RT)
    feature.set_image(name, image, pyoidn.OIDN_FORMAT_FLOAT3)
    feature.set_image("output", result, pyoidn.OIDN_FORMAT_FLOAT3)
    feature.commit()
    feature.execute()
    feature.release()
    return result


def measured(work, rounds):
    """The result of work(), and CPU and wall seconds of each round."""
    work()
    cost = {"cpu": [], "wall": []}
    for _ in range(rounds):
        cpu, wall = time.process_time(), time.perf_counter()
        result = work()
        cost["cpu"].append(time.process_time() - cpu)
        cost["wall"].append(time.perf_counter() - wall)
    return result, cost


def write_image(path, file, image):
    names = dict(zip("RGB", np.moveaxis(image, -1, 0)))
    height, width = image.shape[:2]
    y, x = np.mgrid[0:height, 0:width]
    left, top = file[0]["dataWindow"][:2]
    film = {"film.X": x.ravel() + left + 0.5, "film.Y": y.ravel() + top + 0.5}
    channels = {**{n: plane.ravel() for n, plane in names.items()}, **film}
    write_samples(path, file[0]["dataWindow"], np.ones(width * height), channels)


def main():
    source, noisy_path, clean_path, rounds = sys.argv[1:5]
    file = read_samples(source)
    color = mean_image(file, "RGB")
    features = {"albedo": mean_image(file, [f"feature.albedo.{c}" for c in "RGB"]),
                "normal": mean_image(file, [f"feature.N.{c}" for c in "XYZ"])}
    features = {name: image for name, image in features.items() if image is not None}
    if "albedo" not in features:
        features = {}  # normals alone are not accepted
    device = pyoidn.Device()
    device.commit()

    def with_clean_features():
        clean = {name: prefiltered(device, name, image) for name, image in features.items()}
        return pyoidn.denoise(color, **clean, hdr=True, clean_aux=bool(clean))

    noisy, noisy_cost = measured(lambda: pyoidn.denoise(color, **features, hdr=True), int(rounds))
    clean, clean_cost = measured(with_clean_features, int(rounds))
    write_image(noisy_path, file, noisy)
    write_image(clean_path, file, clean)
    print(json.dumps({"OIDN": noisy_cost, "OIDN, prefiltered features": clean_cost, "features": sorted(features)}))


main()
