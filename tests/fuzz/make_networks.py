"""Writes the network files that the fuzzer starts from: small ones that are whole, and malformed ones. Usage: make_networks.py FOLDER"""
import json
import struct
import sys
from pathlib import Path

FOLDER = Path(sys.argv[1])
LARGEST, TINY, INFINITE, NAN = 0x7BFF, 0x0001, 0x7C00, 0x7E01  # binary16


def value_count(features, channels, embedding, dilations, albedo_dilations):
    """Weights and biases of docs/network.md, "Layers"."""
    pairs = [(30, features), (features, features), (2 * features + 18, channels[0]), (9 * channels[0], channels[0])]
    for above, own in zip(channels, channels[1:]):
        pairs += [(9 * above, own), (9 * own, own), (9 * (own + above), above), (9 * above, above)]
    pairs += [(channels[0], 9 + (len(dilations) + len(albedo_dilations)) * (embedding + 11)), (features + 8, 16), (16, 1)]
    return sum((inputs + 1) * outputs for inputs, outputs in pairs)


def network(value, features=1, channels=(1,), embedding=1, dilations=(2, 1), albedo_dilations=(1,)):
    """`value(i)`: number i as binary16 bits."""
    text = {"format": "rpf-network", "version": 2, "name": "fuzz", "sample_features": features, "channels": channels, "embedding": embedding,
            "dilations": dilations, "albedo_dilations": albedo_dilations}
    count = value_count(features, channels, embedding, dilations, albedo_dilations)
    return json.dumps(text).encode() + b"\n" + struct.pack(f"<{count}H", *map(value, range(count)))


def ordinary(i):
    return (0x2C00 if i % 3 else 0xB000) + i * 37 % 0x400  # +-1/16 .. 1/4


def main():
    FOLDER.mkdir(parents=True, exist_ok=True)
    good = network(ordinary)
    files = {"good": good, "two_levels": network(ordinary, 2, (2, 3), 2), "three_levels": network(ordinary, 1, (1, 1, 1), 1, (8, 3, 1), (5, 1, 2)),
             "zeros": network(lambda i: 0), "tiny": network(lambda i: TINY + i % 2 * 0x8000), "largest": network(lambda i: LARGEST),
             "largest_signs": network(lambda i: LARGEST + i * 7 % 3 % 2 * 0x8000, 2, (2, 2), 3), "lowest": network(lambda i: LARGEST | 0x8000),
             "one_infinite": network(lambda i: INFINITE if i == 40 else ordinary(i)), "one_nan": network(lambda i: NAN if i == 90 else ordinary(i)),
             "longer": good + b"xx", "odd": good[:-1], "no_weights": good[:good.index(b"\n") + 1], "no_line": good[:good.index(b"\n")], "nothing": b"",
             "deep": b'{"a":' * 5000 + b"\n", "brackets": b"[" * 5000, "not_utf8": good.replace(b"fuzz", b"\xff\xfe\xfd\xfc"),
             "twice": good.replace(b'{"format"', b'{"version": 7, "format"')}
    for name, header in (("name_control", {"name": "\x1b[31m"}), ("name_lines", {"name": "a\nb"}), ("name_none", {"name": ""}), ("name_long", {"name": "x" * 65}),
                         ("name_number", {"name": 7}), ("features_0", {"sample_features": 0}), ("features_huge", {"sample_features": 2**63}),
                         ("features_float", {"sample_features": 1.0}), ("channels_none", {"channels": []}), ("channels_text", {"channels": "1"}),
                         ("channels_negative", {"channels": [-1]}), ("channels_many", {"channels": [1] * 9}), ("channels_large", {"channels": [512] * 8}),
                         ("embedding_65", {"embedding": 65}), ("embedding_null", {"embedding": None}), ("version_3", {"version": 3}), ("version_1", {"version": 1}), ("dilations_none", {"dilations": []}),
                         ("dilations_9", {"dilations": [9, 1]}), ("dilations_text", {"albedo_dilations": "1"}), ("dilations_many", {"dilations": [1] * 9}), ("format", {"format": ["rpf-network"]})):
        text = {**json.loads(good[:good.index(b"\n")]), **header}
        files[name] = json.dumps(text).encode() + good[good.index(b"\n"):]
    for name, content in files.items():
        (FOLDER / f"{name}.rpfnet").write_bytes(content)


main()
