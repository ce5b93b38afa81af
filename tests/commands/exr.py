"""Reads single-part scanline EXR files of floats, zip-compressed: just what photopic writes. Writes them uncompressed,
with channels of any name."""

import struct
import zlib


def text(data, at):
    end = data.index(b"\0", at)
    return data[at:end].decode(), end + 1


def read_header(data):
    """Returns the attributes as bytes, and where the header ends."""
    assert data[:4] == b"\x76\x2f\x31\x01"
    attributes, at = {}, 8
    while data[at]:
        name, at = text(data, at)
        _, at = text(data, at)
        (size,) = struct.unpack_from("<i", data, at)
        attributes[name] = data[at + 4 : at + 4 + size]
        at += 4 + size
    return attributes, at + 1


def channel_names(attribute):
    names, at = [], 0
    while attribute[at]:
        name, at = text(attribute, at)
        assert struct.unpack_from("<i", attribute, at)[0] == 2, "not float"
        names.append(name)
        at += 16
    return names


def unzip(block, size):
    if len(block) == size:
        return block
    delta = bytearray(zlib.decompress(block))
    for i in range(1, size):
        delta[i] = (delta[i - 1] + delta[i] - 128) & 255
    half = (size + 1) // 2
    result = bytearray(size)
    result[0::2], result[1::2] = delta[:half], delta[half:]
    return bytes(result)


def read_exr(path):
    """Returns the attributes and, by channel name, the pixels row by row."""
    data = path.read_bytes()
    attributes, at = read_header(data)
    assert attributes["compression"] == b"\x03", "not zip"
    x0, y0, x1, y1 = struct.unpack("<4i", attributes["dataWindow"])
    width, height = x1 - x0 + 1, y1 - y0 + 1
    names = channel_names(attributes["channels"])
    channels = {name: [] for name in names}
    for offset in struct.unpack_from(f"<{(height + 15) // 16}Q", data, at):
        y, size = struct.unpack_from("<2i", data, offset)
        rows = min(16, y1 + 1 - y)
        block = unzip(data[offset + 8 : offset + 8 + size], 4 * width * rows * len(names))
        values = struct.unpack(f"<{width * rows * len(names)}f", block)
        for row in range(rows):
            for i, name in enumerate(names):
                begin = (row * len(names) + i) * width
                channels[name] += values[begin : begin + width]
    return attributes, channels


def write_exr(path, channels, width, height, left=0, top=0, full=None):
    """@param channels a value each, for all pixels @param full width and height of the display window"""

    def attribute(name, kind, value):
        return f"{name}\0{kind}\0".encode() + struct.pack("<i", len(value)) + value

    names = sorted(channels)
    full_width, full_height = full or (width, height)
    listed = b"".join(name.encode() + b"\0" + struct.pack("<4i", 2, 0, 1, 1) for name in names) + b"\0"
    header = b"\x76\x2f\x31\x01\x02\0\0\0" + b"".join([
        attribute("channels", "chlist", listed),
        attribute("compression", "compression", b"\0"),
        attribute("dataWindow", "box2i", struct.pack("<4i", left, top, left + width - 1, top + height - 1)),
        attribute("displayWindow", "box2i", struct.pack("<4i", 0, 0, full_width - 1, full_height - 1)),
        attribute("lineOrder", "lineOrder", b"\0"),
        attribute("pixelAspectRatio", "float", struct.pack("<f", 1)),
        attribute("screenWindowCenter", "v2f", struct.pack("<2f", 0, 0)),
        attribute("screenWindowWidth", "float", struct.pack("<f", 1)),
    ]) + b"\0"  # fmt: skip
    row = b"".join(struct.pack("<f", channels[name]) * width for name in names)
    first = len(header) + 8 * height
    offsets = struct.pack(f"<{height}Q", *(first + y * (8 + len(row)) for y in range(height)))
    rows = b"".join(struct.pack("<2i", top + y, len(row)) + row for y in range(height))
    path.write_bytes(header + offsets + rows)
