"""Reads single-part scanline EXR files of floats, zip-compressed: just what photopic writes."""

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
