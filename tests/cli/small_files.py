"""Small files for the tests of the command: raw samples, images in TIFF, flat OpenEXR images, all with numpy alone."""
import json
import struct

import numpy as np

LAYOUT = ["R", "G", "B", "film.X", "film.Y", "random.lens.U", "random.lens.V", "feature.N.X", "feature.N.Y", "feature.N.Z",
          "feature.P.X", "feature.P.Y", "feature.P.Z", "feature.albedo.R", "feature.albedo.G", "feature.albedo.B"]


def frame(width=8, height=6, spp=4, x0=0, y0=0, seed=1):
    """Channels of a frame that keeps the convention: a sloping plane behind a lens, its color noisy by the lens."""
    rng = np.random.default_rng(seed)
    y, x = (v.repeat(spp) for v in np.mgrid[0:height, 0:width].reshape(2, -1))
    u, v, du, dv = rng.random((4, x.size)) * 0.998 + 0.001
    film_x, film_y = x0 + x + du, y0 + y + dv
    normal = np.array([0.0, 0.6, 0.8])
    one = np.ones(x.size)
    position = [film_x, -0.8 * film_y, 0.6 * film_y]  # at right angles to the normal
    values = [0.2 + u, 0.4 + u, 0.6 + v, film_x, film_y, u, v, *(n * one for n in normal), *position, 0.5 * one, 0.4 * one + 0.1 * u, 0.3 * one]
    return {name: np.asarray(value, "<f4") for name, value in zip(LAYOUT, values)}


def write_raw(path, channels, width=8, height=6, spp=4, x0=0, y0=0):
    """`spp`: of all pixels, or a list of those of each."""
    header = {"format": "rpf-raw-samples", "version": 1, "dataWindow": [x0, y0, width, height], "channels": list(channels), "metadata": {}}
    with open(path, "wb") as file:
        file.write(json.dumps(header).encode() + b"\n")
        np.broadcast_to(np.asarray(spp, "<u4"), width * height).tofile(file)
        for values in channels.values():
            np.asarray(values, "<f4").tofile(file)


def attribute(name, kind, value):
    return name.encode() + b"\0" + kind.encode() + b"\0" + struct.pack("<I", len(value)) + value


def write_exr(path, channels, x0=0, y0=0, display=None, attributes=()):
    """A flat image without compression. `channels`: [height, width] arrays of uint32, float16 or float32 by name;
    `attributes`: (name, type, bytes) beside the required ones."""
    names = sorted(channels)
    height, width = channels[names[0]].shape
    kinds = {np.dtype("uint32"): 0, np.dtype("float16"): 1, np.dtype("float32"): 2}
    table = b"".join(n.encode() + b"\0" + struct.pack("<iiii", kinds[channels[n].dtype], 0, 1, 1) for n in names) + b"\0"
    window = struct.pack("<4i", x0, y0, x0 + width - 1, y0 + height - 1)
    shown = window if display is None else struct.pack("<4i", *display)
    header = b"".join(attribute(*a) for a in [
        ("channels", "chlist", table), ("compression", "compression", b"\0"), ("dataWindow", "box2i", window), ("displayWindow", "box2i", shown),
        ("lineOrder", "lineOrder", b"\0"), ("pixelAspectRatio", "float", struct.pack("<f", 1)), ("screenWindowCenter", "v2f", struct.pack("<2f", 0, 0)),
        ("screenWindowWidth", "float", struct.pack("<f", 1)), *attributes]) + b"\0"
    rows = [b"".join(channels[n][y].tobytes() for n in names) for y in range(height)]
    begin, offsets, chunks = 8 + len(header) + 8 * height, b"", b""
    for y, row in enumerate(rows):
        offsets += struct.pack("<Q", begin + len(chunks))
        chunks += struct.pack("<ii", y0 + y, len(row)) + row
    path.write_bytes(struct.pack("<II", 20000630, 2) + header + offsets + chunks)


def write_tiff(path, pages):
    """Pages of [height, width, 3] bytes or 16-bit numbers, without compression."""
    data, links = b"", []
    for page in pages:
        height, width, _ = page.shape
        pixels = 8 + len(data)
        data += page.tobytes() + struct.pack("<3H", *3 * [8 * page.itemsize])
        bits = pixels + page.nbytes
        entries = [(256, 3, 1, width), (257, 3, 1, height), (258, 3, 3, bits), (259, 3, 1, 1), (262, 3, 1, 2), (273, 4, 1, pixels), (277, 3, 1, 3), (278, 3, 1, height), (279, 4, 1, page.nbytes)]
        data += b"\0" * (len(data) % 2)
        links.append(8 + len(data))
        data += struct.pack("<H", len(entries)) + b"".join(struct.pack("<HHII", *e) for e in entries) + b"NEXT"
    for following in links[1:] + [0]:
        data = data.replace(b"NEXT", struct.pack("<I", following), 1)
    path.write_bytes(struct.pack("<2sHI", b"II", 42, links[0]) + data)
