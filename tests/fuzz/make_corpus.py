"""Writes the malformed sample files that the fuzzer starts from, made from files of our own writer.
Usage: make_corpus.py RPF FOLDER"""
import json
import struct
import subprocess
import sys
import tempfile
from pathlib import Path

from exr_file import ExrFile, pack

RPF, FOLDER = sys.argv[1], Path(sys.argv[2])
CHANNELS = ["R", "G", "B", "film.X", "film.Y", "random.lens.U"]
FAR = 2**31 - 1


def save(name, data):
    (FOLDER / name).write_bytes(data)


def raw_file(window=(-3, 2, 4, 3), counts=None, values=None, **header):
    pixels = window[2] * window[3]
    counts = [pixel % 3 for pixel in range(pixels)] if counts is None else counts
    values = [0.25 * (i % 7) for i in range(sum(counts) * len(CHANNELS))] if values is None else values
    text = {"format": "rpf-raw-samples", "version": 1, "dataWindow": list(window), "channels": CHANNELS, **header}
    line = json.dumps({key: value for key, value in text.items() if value is not None}).encode() + b"\n"
    return line + pack(f"{len(counts)}I", *counts) + pack(f"{len(values)}f", *values)


def converted(data):
    """A raw file through our own writer of deep OpenEXR."""
    with tempfile.TemporaryDirectory() as folder:
        raw, exr = Path(folder) / "a.rpf", Path(folder) / "a.exr"
        raw.write_bytes(data)
        subprocess.run([RPF, "convert", raw, "-o", exr], check=True, stdout=subprocess.DEVNULL)
        return exr.read_bytes()


GOOD = converted(raw_file(metadata={"rpf:seed": 5, "note": "a text", "list": [1.5, 2.5], "half": 0.5}))


def zips():
    return ExrFile(GOOD)


def plain():
    return ExrFile(GOOD).uncompressed()


def whole_files():
    save("zips.exr", zips().bytes())
    save("none.exr", plain().bytes())
    save("rle.exr", ExrFile(GOOD).uncompressed(1).bytes())
    save("raw.rpf", raw_file())
    save("empty_pixels.exr", converted(raw_file(counts=[0] * 12)))
    save("one_pixel.exr", converted(raw_file(window=(100000, 5, 1, 1), counts=[3])))
    save("trailing.exr", zips().bytes() + b"more")


def truncations():
    """Behind every part of the file: header, table, and in every chunk its header, its counts, its samples."""
    for name, file in (("zips", zips()), ("none", plain())):
        data, parts = file.bytes(), file.parts()
        ends = [len(parts[0]), len(parts[0]) + len(parts[1])]
        for chunk in file.chunks:
            start = ends[-1]
            ends += [start + 28, start + 28 + len(chunk.table), start + len(chunk.bytes())]
        for end in ends[:-1]:
            save(f"cut_{name}_{end}.exr", data[:end])


def forged_counts():
    """Counts are cumulative: too large, falling, and with another sum than the samples that are there."""
    for name, counts in (("falling", (3, 1, 2, 3)), ("huge", (0, 2**31, 2**31, 3)), ("wrap", (2**32 - 1, 0, 1, 3)), ("more", (0, 1, 3, 4)),
                         ("negative", (0, -1 & 0xffffffff, 0, 3))):
        file = plain()
        file.chunks[0].table = pack("4I", *counts)
        save(f"counts_{name}.exr", file.bytes())
    for which, what in enumerate(("table", "packed", "unpacked")):
        for size in (0, 1, 24 * 9, 24 * 80000000, 2**31, 2**32, 2**63, 2**64 - 1):
            file = zips()
            file.chunks[1].sizes[which] = size
            save(f"size_{what}_{size}.exr", file.bytes())
    for name, offset in (("none", 0), ("header", 8), ("self", len(zips().parts()[0])), ("end", len(GOOD) - 5), ("far", 2**40), ("farthest", 2**64 - 1)):
        file = zips()
        file.offsets[1] = offset
        save(f"offset_{name}.exr", file.bytes())


def windows():
    for name, corners in (("16k", (0, 0, 16383, 16383)), ("wide", (0, 0, 2**20, 0)), ("none", (0, 0, -1, 0)), ("shifted", (-3, 3, 0, 5)),
                          ("far", (-FAR - 1, -FAR - 1, FAR, FAR)), ("edge", (FAR - 3, 2, FAR, 4)), ("taller", (-3, 2, 0, 5)), ("wider", (-3, 2, 1, 4))):
        save(f"window_{name}.exr", zips().set("dataWindow", pack("4i", *corners)).bytes())
        save(f"display_{name}.exr", zips().set("displayWindow", pack("4i", *corners)).bytes())


def header_edits():
    for name in [attribute[0] for attribute in zips().attributes]:
        file = zips()
        file.attributes.remove(file.attribute(name))
        save(f"without_{name.replace(':', '_')}.exr", file.bytes())
        value = file.bytes() and zips().attribute(name)[2]
        save(f"shorter_{name.replace(':', '_')}.exr", zips().set(name, value[:-1]).bytes())
    for name, claimed in (("rpf:renderer", FAR), ("note", FAR), ("channels", 2**32 - 1), ("list", 7), ("list", 2**32 - 4)):
        value = zips().attribute(name)[2] if any(a[0] == name for a in zips().attributes) else None
        if value is not None:
            save(f"claims_{name.replace(':', '_')}_{claimed}.exr", zips().set(name, value, claimed).bytes())
    for compression in (1, 2, 3, 4, 9, 10, 255):
        save(f"compression_{compression}.exr", zips().set("compression", bytes([compression])).bytes())
    for order in (1, 2, 3):
        save(f"line_order_{order}.exr", zips().set("lineOrder", bytes([order])).bytes())
    for kind in (b"deeptile", b"scanlineimage", b"tiledimage", b"deepscanlin\xff"):
        save(f"type_{kind[:8].decode()}.exr", zips().set("type", kind).bytes())
    for version in (1, 2, 0x202, 0x802, 0xa02, 0x1802, 0xffffff02):
        file = zips()
        file.magic = file.magic[:4] + pack("I", version)
        save(f"version_{version:x}.exr", file.bytes())
    for number in (0, 2, FAR, -1):
        save(f"chunk_count_{number}.exr", zips().set("chunkCount", pack("i", number)).bytes())
    for bits in (0, 0x7fc00000, 0x7f800000, 0xff800000, 1):
        save(f"aspect_{bits:x}.exr", zips().set("pixelAspectRatio", pack("I", bits)).bytes())


def channels():
    def listed(rows):
        return b"".join(name.encode() + b"\0" + pack("iBxxxii", kind, 0, *sampling) for name, kind, sampling in rows) + b"\0"

    names = sorted(CHANNELS)
    good = [(name, 2, (1, 1)) for name in names]
    assert listed(good) == zips().attribute("channels")[2]
    edits = {"subsampled": [(names[0], 2, (2, 1)), *good[1:]], "sampling_0": [(names[0], 2, (0, 1)), *good[1:]], "integer": [(names[0], 0, (1, 1)), *good[1:]],
             "half": [(names[0], 1, (1, 1)), *good[1:]], "type_3": [(names[0], 3, (1, 1)), *good[1:]], "type_far": [(names[0], FAR, (1, 1)), *good[1:]],
             "unsorted": good[::-1], "twice": [good[0], *good], "no_R": [row for row in good if row[0] != "R"], "none": [],
             "control": [("\x1b[31m", 2, (1, 1)), *good], "long": [*good, ("z" * 256, 2, (1, 1))], "layer": [*good, ("z" * 255, 2, (1, 1))],
             "two_aliases": [*good, ("N.X", 2, (1, 1)), ("nn.X", 2, (1, 1))], "depth": [(name, 2, (1, 1)) for name in "ABGRZ"],
             "1025": [(f"a{i:04}", 2, (1, 1)) for i in range(1025)]}
    for name, rows in edits.items():
        save(f"channels_{name}.exr", zips().set("channels", listed(sorted(rows) if name in ("two_aliases",) else rows)).bytes())
    save("channels_open.exr", zips().set("channels", listed(good)[:-1]).bytes())


def bombs():
    """Small files that unpack to much more: constant samples, and rows without any."""
    width, count = 8192, 16
    constant = converted(raw_file(window=(0, 0, width, 1), counts=[count] * width, values=[1.0] * (width * count * len(CHANNELS))))
    save("bomb_constant.exr", constant)
    save("bomb_pixels.exr", converted(raw_file(window=(0, 0, 2**16, 2), counts=[0] * 2**17, values=[])))


def raw_files():
    good = raw_file()
    line = good.index(b"\n")
    for end in (0, 1, line, line + 1, line + 3, line + 1 + 4 * 12, len(good) - 1):
        save(f"raw_cut_{end}.rpf", good[:end])
    save("raw_longer.rpf", good + b"more")
    for name, counts in (("huge", [2**32 - 1] + [0] * 11), ("wrap", [2**32 - 1, 2**32 - 1, 14] + [0] * 9), ("less", [0] * 12)):
        save(f"raw_counts_{name}.rpf", raw_file(counts=counts, values=[0.5] * 72))
    for name, window in (("16k", [0, 0, 16384, 16384]), ("far", [2**31 - 1, 0, 4, 3]), ("negative", [0, 0, -4, -3]), ("float", [0, 0, 4.5, 3]),
                         ("short", [0, 0, 4]), ("nothing", None), ("text", "4x3"), ("2^63", [0, 0, 2**63, 3]), ("2^64", [0, 0, 2**64, 3])):
        save(f"raw_window_{name}.rpf", raw_file(dataWindow=window))
    for name, header in (("twice", {"channels": ["R", "R", "G", "B", "film.X", "film.Y"]}), ("empty", {"channels": []}), ("numbers", {"channels": [1, 2, 3, 4, 5, 6]}),
                         ("control", {"channels": ["R", "G", "B", "film.X", "film.Y", "\x1b[31m"]}), ("many", {"channels": [f"c{i}" for i in range(1025)]}),
                         ("version", {"version": 2}), ("version_text", {"version": "1"}), ("format", {"format": "other"}), ("unknown", {"more": 1}),
                         ("display", {"displayWindow": [0, 0, 0, 0]}), ("metadata", {"metadata": {"a": 1e39, "b": 2**40, "c": [1, "x"], "": 0}}),
                         ("metadata_list", {"metadata": [1]}), ("nested", {"metadata": {"a": [[[[1]]]]}})):
        save(f"raw_{name}.rpf", raw_file(**header))
    save("raw_deep.rpf", b"{" + b'"a":[' * 5000 + b"\n" + good[line + 1:])
    save("raw_not_utf8.rpf", good.replace(b'"R"', b'"\xff"'))
    save("raw_no_line.rpf", b"{" * 3000)


def main():
    FOLDER.mkdir(parents=True, exist_ok=True)
    for make in (whole_files, truncations, forged_counts, windows, header_edits, channels, bombs, raw_files):
        make()
    save("nothing.exr", b"")
    save("text.exr", b"this is no picture at all")


main()
