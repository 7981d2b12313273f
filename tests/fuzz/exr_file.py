"""A deep OpenEXR file of our own writer taken apart and put together again, right or wrong, for make_corpus.py."""
import struct
import zlib


def pack(text, *numbers):
    return struct.pack("<" + text, *numbers)


def unzip(data, size):
    """ZIPS: deflate of bytes that were split in two halves and stored as differences; as it is where that is no gain."""
    if len(data) == size:
        return data
    plain = bytearray(zlib.decompress(data))
    for i in range(1, len(plain)):
        plain[i] = (plain[i - 1] + plain[i] - 128) & 255
    half = (len(plain) + 1) // 2
    result = bytearray(len(plain))
    result[0::2], result[1::2] = plain[:half], plain[half:]
    return bytes(result)


class Chunk:
    """A row: y, its cumulative counts, its samples, and the sizes that its header claims."""

    def __init__(self, y, table, samples, unpacked):
        self.y, self.table, self.samples = y, table, samples
        self.sizes = [len(table), len(samples), unpacked]

    def bytes(self):
        return pack("i", self.y) + pack("QQQ", *self.sizes) + self.table + self.samples


class ExrFile:
    def __init__(self, data):
        self.magic, self.attributes, at = data[:8], [], 8
        while data[at] != 0:
            name, kind, _ = data[at:].split(b"\0", 2)
            at += len(name) + len(kind) + 2
            size, = struct.unpack_from("<I", data, at)
            self.attributes.append([name.decode(), kind.decode(), data[at + 4:at + 4 + size], None])
            at += 4 + size
        rows = self.window()[3] - self.window()[1] + 1
        self.header_size, self.tail = at + 1, b""
        self.chunks, self.offsets = [], {}
        for offset in struct.unpack_from(f"<{rows}Q", data, at + 1):
            y, table, packed, unpacked = struct.unpack_from("<iQQQ", data, offset)
            begin = offset + 28
            self.chunks.append(Chunk(y, data[begin:begin + table], data[begin + table:begin + table + packed], unpacked))

    def attribute(self, name):
        return next(a for a in self.attributes if a[0] == name)

    def window(self):
        return struct.unpack("<4i", self.attribute("dataWindow")[2])

    def set(self, name, value, claimed=None):
        """`claimed`: the size that the header says, where it is not that of the value."""
        self.attribute(name)[2:] = [value, claimed]
        return self

    def uncompressed(self, compression=0):
        """RLE too stores bytes as they are where packing is no gain."""
        width = self.window()[2] - self.window()[0] + 1
        for chunk in self.chunks:
            chunk.table, chunk.samples = unzip(chunk.table, 4 * width), unzip(chunk.samples, chunk.sizes[2])
            chunk.sizes[:2] = len(chunk.table), len(chunk.samples)
        return self.set("compression", bytes([compression]))

    def parts(self):
        """Header, table of rows and chunks; together they are the file."""
        header = self.magic
        for name, kind, value, claimed in self.attributes:
            header += name.encode() + b"\0" + kind.encode() + b"\0" + pack("I", len(value) if claimed is None else claimed) + value
        header += b"\0"
        offsets, at = [], len(header) + 8 * len(self.chunks)
        for chunk in self.chunks:
            offsets.append(at)
            at += len(chunk.bytes())
        for row, offset in self.offsets.items():
            offsets[row] = offset
        return [header, pack(f"{len(offsets)}Q", *offsets), *(chunk.bytes() for chunk in self.chunks), self.tail]

    def bytes(self):
        return b"".join(self.parts())
