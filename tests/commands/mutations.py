"""Malformed glTF files, made systematically from valid ones.

Every generator yields (name, bytes): a file that differs from a valid one in one place. What comes of it is not known here;
what must hold of any of them is in test_malformed.py."""

import base64
import copy
import json
import struct

HUGE = "@huge@"  # stands for 1e999, which Python's json cannot write

WRONG_VALUES = [None, True, -1, 0, 1.5, 4294967296, 18446744073709551615, -9223372036854775808, 1e300, HUGE, "", "\u0000\n\u001b[2J",
                [], {}, [[]], [None], {"": {}}]  # fmt: skip


def encode(document):
    return json.dumps(document).replace(f'"{HUGE}"', "1e999").encode()


def places(value, path=()):
    """All paths to members and elements, parents first."""
    items = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    for key, child in items:
        yield (*path, key)
        yield from places(child, (*path, key))


def parent_of(document, path):
    for key in path[:-1]:
        document = document[key]
    return document


def pointer(path):
    return "/" + "/".join(str(key) for key in path)


def changed(document, path, change):
    """A copy in which `change(parent, key)` was done."""
    result = copy.deepcopy(document)
    change(parent_of(result, path), path[-1])
    return result


def member_mutations(document):
    """Each member removed, and given each wrong value; elements of long lists are all alike, so only their first two count."""
    for path in places(document):
        if any(isinstance(key, int) and key > 1 for key in path[2:]):
            continue
        yield f"no {pointer(path)}", encode(changed(document, path, lambda parent, key: parent.pop(key)))
        for value in WRONG_VALUES:

            def put(parent, key, value=value):
                parent[key] = value

            name = f"{pointer(path)} = {json.dumps(value)}".replace(f'"{HUGE}"', "1e999")
            yield name, encode(changed(document, path, put))


def structure_mutations(document):
    """What no single value says: cycles, sharing, lengths that do not fit, doubled keys."""

    def edited(edit):
        result = copy.deepcopy(document)
        edit(result)
        return encode(result)

    for node in range(len(document["nodes"])):
        yield f"node {node} in a cycle", edited(lambda d: d["nodes"][node].setdefault("children", []).append(0))
    yield "own child", edited(lambda d: d["nodes"][0].update(children=[0]))
    yield "diamonds", edited(
        lambda d: (
            d["nodes"].extend({"children": [len(d["nodes"]) + i + 1] * 2} for i in range(40)),
            d["nodes"].append({"mesh": 0}),
            d["scenes"].append({"nodes": [len(d["nodes"]) - 41]}),
            d.update(scene=len(d["scenes"]) - 1),
        )
    )
    for length in (0, 1, 100):
        yield f"buffer of {length} bytes", edited(
            lambda d: d["buffers"][0].update(uri="data:;base64," + base64.b64encode(bytes(length)).decode())
        )
    for scheme in ("http://example.org/a.bin", "file:///etc/passwd", "data:", "data:,x", "data:;base64,====", "%", "..", "a\u0000b", "/"):
        yield f"uri {scheme!r}", edited(lambda d: d["buffers"][0].update(uri=scheme))
    for name in ("KHR_draco_mesh_compression", "EXT_meshopt_compression", "X" * 5000, "bad\nname"):
        yield f"requires {name[:20]!r}", edited(lambda d: d.update(extensionsRequired=[name]))
    for view in range(len(document.get("bufferViews", []))):
        for key, value in (("byteOffset", 1 << 52), ("byteLength", 1 << 52), ("byteStride", 4), ("byteStride", 252)):
            yield f"view {view} {key} {value}", edited(lambda d: d["bufferViews"][view].update({key: value}))
    for accessor in range(len(document.get("accessors", []))):
        for change in (
            {"count": 1 << 30},
            {"count": 1 << 60},
            {"count": 3},
            {"componentType": 5120},
            {"componentType": 5125},
            {"componentType": 5130},
            {"type": "MAT4"},
            {"type": "SCALAR"},
            {"byteOffset": 2},
        ):
            yield f"accessor {accessor} {change}", edited(lambda d: d["accessors"][accessor].update(change))


def text_mutations(data):
    """Of the JSON as text."""
    text = data.decode()
    yield "a key twice", text.replace('"asset"', '"asset": {"version": "2.0"}, "asset"', 1).encode()
    yield "deep lists", b'{"asset": {"version": "2.0", "extras": ' + b"[" * 200_000 + b"]" * 200_000 + b"}}"
    yield "deep objects", b'{"asset": {"version": "2.0", "extras": ' + b'{"a":' * 200_000 + b"1" + b"}" * 200_000 + b"}}"
    yield "deep and open", b"[" * 1_000_000
    yield "a long string", b'{"asset": {"version": "2.0", "generator": "' + b"x" * 4_000_000 + b'"}}'
    yield "a long number", b'{"asset": {"version": "2.0", "extras": ' + b"9" * 1_000_000 + b"}}"
    yield "invalid UTF-8", data.replace(b'"2.0"', b'"2.0", "generator": "\xff\xfe\xc0"', 1)
    yield "half a surrogate", data.replace(b'"2.0"', b'"2.0", "generator": "\\ud800"', 1)
    yield "a byte order mark", b"\xef\xbb\xbf" + data
    yield "UTF-16", text[:2000].encode("utf-16")
    yield "NaN", data.replace(b"2.0", b"NaN", 1)
    for part in range(0, 20):
        yield f"{part} twentieths", data[: len(data) * part // 20]
    for step in range(0, len(data), max(1, len(data) // 40)):
        yield f"zero at {step}", data[:step] + b"\0" + data[step + 1 :]
        yield f"bracket at {step}", data[:step] + b"]" + data[step + 1 :]


def glb(document, binary, version=2, length=None, chunks=None, magic=b"glTF"):
    text = encode(document)
    text += b" " * (-len(text) % 4)
    binary += bytes(-len(binary) % 4)
    chunks = chunks or [(len(text), b"JSON", text), (len(binary), b"BIN\0", binary)]
    body = b"".join(struct.pack("<I4s", size, kind) + data for size, kind, data in chunks)
    return struct.pack("<4sII", magic, version, 12 + len(body) if length is None else length) + body


def glb_mutations(document):
    """`document` has one buffer, a data URI, which becomes the binary chunk."""
    document = copy.deepcopy(document)
    binary = base64.b64decode(document["buffers"][0].pop("uri").split(",")[1])
    text = encode(document)
    whole = glb(document, binary)
    yield "glb", whole
    for part in range(0, 40):
        yield f"glb, {part} fortieths", whole[: len(whole) * part // 40]
    for size in range(0, 28):
        yield f"glb of {size} bytes", whole[:size]
    for length in (0, 11, 12, 20, len(whole) - 1, len(whole) + 1, 0xFFFFFFFF):
        yield f"glb length {length}", glb(document, binary, length=length)
    for version in (0, 1, 3, 0xFFFFFFFF):
        yield f"glb version {version}", glb(document, binary, version=version)
    yield "glb magic", glb(document, binary, magic=b"glTG")
    yield "glb with a tail", whole + b"tail" * 10
    padded = text + b"\0" * (-len(text) % 4)
    yield "glb padded with zeros", glb(document, binary, chunks=[(len(padded), b"JSON", padded), (len(binary), b"BIN\0", binary)])
    orders = {
        "no chunks": [(0, b"", b"")][:0] or [(0, b"NONE", b"")],
        "binary first": [(len(binary), b"BIN\0", binary), (len(text), b"JSON", text)],
        "two texts": [(len(text), b"JSON", text)] * 2,
        "no binary": [(len(text), b"JSON", text)],
        "short binary": [(len(text), b"JSON", text), (4, b"BIN\0", binary[:4])],
        "empty text": [(0, b"JSON", b""), (len(binary), b"BIN\0", binary)],
        "huge text": [(0xFFFFFFFF, b"JSON", text), (len(binary), b"BIN\0", binary)],
        "huge binary": [(len(text), b"JSON", text), (0xFFFFFFF0, b"BIN\0", binary)],
        "unknown third": [(len(text), b"JSON", text), (len(binary), b"BIN\0", binary), (4, b"ABCD", b"abcd")],
    }
    for name, chunks in orders.items():
        yield f"glb, {name}", glb(document, binary, chunks=chunks)


def binary_mutations(document):
    """The buffer's numbers: all zeros, all ones (NaN for floats), bytes turned over one by one."""
    binary = bytearray(base64.b64decode(document["buffers"][0]["uri"].split(",")[1]))

    def with_bytes(data):
        result = copy.deepcopy(document)
        result["buffers"][0]["uri"] = "data:;base64," + base64.b64encode(data).decode()
        return encode(result)

    yield "zeros", with_bytes(bytes(len(binary)))
    yield "ones", with_bytes(b"\xff" * len(binary))
    yield "infinities", with_bytes((struct.pack("<f", float("inf")) * len(binary))[: len(binary)])
    for i in range(0, len(binary), max(4, len(binary) // 400 * 4)):
        for word in (b"\xff\xff\xff\xff", b"\x00\x00\x80\x7f", b"\xff\xff\x7f\x7f"):
            yield f"word {i} {word.hex()}", with_bytes(bytes(binary[:i]) + word + bytes(binary[i + 4 :]))


def all_mutations(document):
    yield from structure_mutations(document)
    yield from text_mutations(encode(document))
    yield from glb_mutations(document)
    yield from binary_mutations(document)
    yield from member_mutations(document)
