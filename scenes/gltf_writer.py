"""Writes small glTF 2.0 scenes. Rerunning a script reproduces its files byte for byte. Standard library only."""

import json
import math
import struct
import zlib


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def subtract(a, b):
    return tuple(x - y for x, y in zip(a, b))


def turned(axis, degrees):
    """The rotation about a unit axis, as glTF's quaternion."""
    half = math.radians(degrees) / 2
    return [*(math.sin(half) * x for x in axis), math.cos(half)]


def product(p, q):
    """The rotation q, then p."""
    (a, b, c, d), (e, f, g, h) = p, q
    return [d * e + a * h + b * g - c * f, d * f - a * g + b * h + c * e, d * g + a * f - b * e + c * h, d * h - a * e - b * f - c * g]


def tiled(quad, tile):
    """Texture coordinates of a rectangle's corners."""
    width, height = (math.dist(quad[0], quad[i]) / tile for i in (1, 3))
    return [(0, height), (width, height), (width, 0), (0, 0)]


def lambert(name, color, **more):
    """A purely diffuse material: opaque with specularFactor 0. `color` is linear sRGB."""
    return {
        "name": name,
        "pbrMetallicRoughness": {"baseColorFactor": [*color, 1], "metallicFactor": 0, "roughnessFactor": 1},
        "extensions": {"KHR_materials_specular": {"specularFactor": 0}},
        **more,
    }


def lamp(name, reflectance, luminance, spectrum):
    """A diffuse emitter of `luminance` [cd/m2] with a named spectrum."""
    material = lambert(name, [reflectance] * 3, emissiveFactor=[1, 1, 1], extras={"emission_spectrum": spectrum})
    material["extensions"]["KHR_materials_emissive_strength"] = {"emissiveStrength": luminance}
    return material


def png(width, height, pixel):
    """An 8-bit RGB PNG; pixel(x, y) gives three numbers from 0 to 1, sRGB-encoded."""
    rows = b"".join(b"\0" + bytes(min(max(round(255 * c), 0), 255) for x in range(width) for c in pixel(x, y)) for y in range(height))
    chunk = lambda kind, data: struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    header = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b"")


def hdr(width, height, radiance):
    """A Radiance picture of all directions, in latitude and longitude: its middle in direction −z, its upper edge +y; +x lies right
    of the middle. radiance(unit direction) gives three numbers in linear sRGB, not negative."""
    pixels = bytearray()
    for row in range(height):
        theta = math.pi * (row + 0.5) / height
        for column in range(width):
            phi = 2 * math.pi * ((column + 0.5) / width - 0.5)
            rgb = radiance((math.sin(theta) * math.sin(phi), math.cos(theta), -math.sin(theta) * math.cos(phi)))
            exponent = math.frexp(max(rgb))[1] if max(rgb) > 1e-32 else -128
            pixels += bytes([*(min(255, int(256 * c / 2.0**exponent)) for c in rgb), exponent + 128])
    return f"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {height} +X {width}\n".encode() + pixels


class Scene:
    def __init__(self, copyright):
        self.bytes = bytearray()
        self.json = {"asset": {"version": "2.0", "generator": "scenes/gltf_writer.py", "copyright": copyright}, "scene": 0,
                     "scenes": [{"nodes": []}], "nodes": [], "meshes": [], "materials": [], "cameras": [], "accessors": [],
                     "bufferViews": []}

    def _append(self, kind, value):
        self.json[kind].append(value)
        return len(self.json[kind]) - 1

    def _append_optional(self, kind, value):
        self.json.setdefault(kind, [])  # glTF allows no empty list
        return self._append(kind, value)

    def _node(self, **node):
        self.json["scenes"][0]["nodes"].append(self._append("nodes", node))

    def _accessor(self, code, component_type, kind, rows, target, bounds=False):
        data = b"".join(struct.pack("<" + code, *row) for row in rows)
        view = self._append("bufferViews", {"buffer": 0, "byteOffset": len(self.bytes), "byteLength": len(data), "target": target})
        self.bytes += data + bytes(-len(data) % 4)
        accessor = {"bufferView": view, "componentType": component_type, "count": len(rows), "type": kind}
        if bounds:  # of the numbers as they stand in the file
            stored = list(struct.iter_unpack("<" + code, data))
            accessor["min"] = [min(column) for column in zip(*stored)]
            accessor["max"] = [max(column) for column in zip(*stored)]
        return self._append("accessors", accessor)

    def texture(self, image):
        """Adds a PNG's bytes. Returns what a material's texture member holds."""
        view = self._append("bufferViews", {"buffer": 0, "byteOffset": len(self.bytes), "byteLength": len(image)})
        self.bytes += image + bytes(-len(image) % 4)
        source = self._append_optional("images", {"bufferView": view, "mimeType": "image/png"})
        return {"index": self._append_optional("textures", {"source": source})}

    def material(self, material):
        return self._append("materials", material)

    def mesh(self, name, material, positions, triangles, normals=None, uvs=None, **node):
        """Adds a mesh under a node of its own; without normals it is flat."""
        attributes = {"POSITION": self._accessor("fff", 5126, "VEC3", positions, 34962, bounds=True)}
        if normals:
            attributes["NORMAL"] = self._accessor("fff", 5126, "VEC3", normals, 34962)
        if uvs:
            attributes["TEXCOORD_0"] = self._accessor("ff", 5126, "VEC2", uvs, 34962)
        indices = self._accessor("H", 5123, "SCALAR", [(i,) for triangle in triangles for i in triangle], 34963)
        primitive = {"attributes": attributes, "indices": indices, "material": material}
        self._node(name=name, mesh=self._append("meshes", {"name": name, "primitives": [primitive]}), **node)

    def quads(self, name, material, quads, tile=None, **node):
        """Quads with their corners counter-clockwise seen from the front. A texture, if asked for, measures `tile` in the
        scene's units and lies along each quad's edges, u along its first."""
        positions = [corner for quad in quads for corner in quad]
        if tile:
            node["uvs"] = [uv for quad in quads for uv in tiled(quad, tile)]
        triangles = [t for q in range(0, 4 * len(quads), 4) for t in ((q, q + 1, q + 2), (q, q + 2, q + 3))]
        self.mesh(name, material, positions, triangles, **node)

    def camera(self, yfov, resolution, **node):
        camera = {"type": "perspective", "name": "camera", "extras": {"resolution": resolution},
                  "perspective": {"yfov": yfov, "aspectRatio": resolution[0] / resolution[1], "znear": 0.01}}
        self._node(name="camera", camera=self._append("cameras", camera), **node)

    def _finish(self, **buffer):
        extensions = sorted({name for material in self.json["materials"] for name in material.get("extensions", {})})
        return {**self.json, "extensionsUsed": extensions, "buffers": [{"byteLength": len(self.bytes), **buffer}]}

    def write_gltf(self, path):
        """Writes path and, beside it, a .bin of the same name."""
        bin_path = path.with_suffix(".bin")
        path.write_text(json.dumps(self._finish(uri=bin_path.name), indent=1) + "\n")
        bin_path.write_bytes(self.bytes)

    def write_glb(self, path):
        text = json.dumps(self._finish(), separators=(",", ":")).encode()
        text += b" " * (-len(text) % 4)
        chunks = struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", len(self.bytes), b"BIN\0") + self.bytes
        path.write_bytes(struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks)
