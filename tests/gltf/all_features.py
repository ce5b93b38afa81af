#!/usr/bin/env python3
"""Writes all_features.gltf: one small valid scene that uses every part of glTF 2.0, and every extension, that the loader
has a rule for. Tests spoil it member by member. Rerunning reproduces the file byte for byte."""

import base64
import json
import pathlib
import struct
import zlib

FLOAT, BYTE, UBYTE, SHORT, USHORT, UINT = 5126, 5120, 5121, 5122, 5123, 5125
CODES = {FLOAT: "f", BYTE: "b", UBYTE: "B", SHORT: "h", USHORT: "H", UINT: "I"}
SIZES = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}


def png(width, height, rgba):
    """8-bit RGBA."""
    rows = b"".join(b"\0" + rgba[4 * width * y : 4 * width * (y + 1)] for y in range(height))
    chunk = lambda kind, data: struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    header = struct.pack(">2I5B", width, height, 8, 6, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b"")


class Buffer:
    def __init__(self):
        self.data, self.views, self.accessors = bytearray(), [], []

    def view(self, data, **more):
        self.data += bytes(-len(self.data) % 4)
        self.views.append({"buffer": 0, "byteOffset": len(self.data), "byteLength": len(data), **more})
        self.data += data
        return len(self.views) - 1

    def accessor(self, kind, component, values, stride=None, **more):
        """`stride` pads every element: vertex attributes begin at multiples of 4 bytes."""
        size, code = SIZES[kind], CODES[component]
        rows = [struct.pack(f"<{size}{code}", *values[i : i + size]) for i in range(0, len(values), size)]
        data = b"".join(row.ljust(stride or len(row), b"\0") for row in rows)
        view = self.view(data, **({"byteStride": stride} if stride else {}))
        return self.add({"bufferView": view, "componentType": component, "count": len(rows), "type": kind, **more})

    def add(self, accessor):
        self.accessors.append(accessor)
        return len(self.accessors) - 1


def attributes(b):
    square = [0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0]
    up = [0, 0, 1] * 4
    whole = {
        "POSITION": b.accessor("VEC3", FLOAT, square, min=[0, 0, 0], max=[1, 1, 0]),
        "NORMAL": b.accessor("VEC3", FLOAT, up),
        "TANGENT": b.accessor("VEC4", FLOAT, [1, 0, 0, 1] * 4),
        "TEXCOORD_0": b.accessor("VEC2", FLOAT, [0, 0, 1, 0, 1, 1, 0, 1]),
        "TEXCOORD_1": b.accessor("VEC2", UBYTE, [0, 0, 255, 0, 255, 255, 0, 255], stride=4, normalized=True),
        "TEXCOORD_2": b.accessor("VEC2", USHORT, [0, 0, 65535, 0, 65535, 65535, 0, 65535], normalized=True),
        "TEXCOORD_3": b.accessor("VEC2", FLOAT, [0, 0, 2, 0, 2, 2, 0, 2]),
        "COLOR_0": b.accessor("VEC4", UBYTE, [255, 255, 255, 255, 128, 255, 255, 255] * 2, normalized=True),
    }
    quantised = {
        "POSITION": b.accessor("VEC3", SHORT, [0, 0, 0, 9, 0, 0, 9, 9, 0, 0, 9, 0], stride=8, min=[0, 0, 0], max=[9, 9, 0]),
        "NORMAL": b.accessor("VEC3", BYTE, [0, 0, 127] * 4, stride=4, normalized=True),
        "COLOR_0": b.accessor("VEC3", FLOAT, [1, 0.5, 0.25] * 4),
    }
    skinned = {
        "POSITION": whole["POSITION"],
        "JOINTS_0": b.accessor("VEC4", UBYTE, [0, 1, 0, 0] * 4),
        "WEIGHTS_0": b.accessor("VEC4", FLOAT, [0.75, 0.25, 0, 0] * 4),
    }
    moved = b.accessor("VEC3", FLOAT, [0, 0, 0.5] * 4)
    return whole, quantised, skinned, [{"POSITION": moved, "NORMAL": moved}, {"POSITION": moved, "TANGENT": moved}]


def sparse_positions(b):
    indices, values = b.view(struct.pack("<2H", 1, 2)), b.view(struct.pack("<6f", 2, 0, 0, 2, 2, 0))
    return b.add({
        "componentType": FLOAT, "count": 4, "type": "VEC3",
        "sparse": {"count": 2, "indices": {"bufferView": indices, "componentType": USHORT}, "values": {"bufferView": values}},
    })  # fmt: skip


def texture(index, **more):
    transform = {"offset": [0.25, 0.5], "rotation": 0.5, "scale": [2, 2], "texCoord": 1}
    return {"index": index, "texCoord": 0, "extensions": {"KHR_texture_transform": transform}, **more}


def materials():
    coated = {
        "name": "coated",
        "pbrMetallicRoughness": {
            "baseColorFactor": [0.5, 0.5, 0.5, 0.75], "metallicFactor": 0.5, "roughnessFactor": 0.5,
            "baseColorTexture": texture(0), "metallicRoughnessTexture": texture(1),
        },
        "normalTexture": texture(0, scale=0.5), "occlusionTexture": texture(0, strength=0.5), "emissiveTexture": texture(0),
        "emissiveFactor": [1, 0.5, 0.25], "alphaMode": "MASK", "alphaCutoff": 0.25, "doubleSided": True,
        "extras": {"note": {"deep": [1, {"deeper": None}]}},
        "extensions": {
            "KHR_materials_emissive_strength": {"emissiveStrength": 20},
            "KHR_materials_clearcoat": {
                "clearcoatFactor": 0.5, "clearcoatRoughnessFactor": 0.25, "clearcoatTexture": texture(0),
                "clearcoatRoughnessTexture": texture(0), "clearcoatNormalTexture": texture(0, scale=1),
            },
            "KHR_materials_sheen": {
                "sheenColorFactor": [0.5, 0.25, 0.125], "sheenRoughnessFactor": 0.5, "sheenColorTexture": texture(0),
                "sheenRoughnessTexture": texture(0),
            },
            "KHR_materials_anisotropy": {"anisotropyStrength": 0.5, "anisotropyRotation": 1, "anisotropyTexture": texture(0)},
            "KHR_materials_iridescence": {
                "iridescenceFactor": 1, "iridescenceIor": 1.25, "iridescenceThicknessMinimum": 100,
                "iridescenceThicknessMaximum": 400, "iridescenceTexture": texture(0), "iridescenceThicknessTexture": texture(0),
            },
            "KHR_materials_specular": {
                "specularFactor": 0.5, "specularColorFactor": [1, 0.5, 0.5], "specularTexture": texture(0),
                "specularColorTexture": texture(0),
            },
        },
    }  # fmt: skip
    glass = {
        "name": "glass",
        "pbrMetallicRoughness": {"metallicFactor": 0, "roughnessFactor": 0},
        "alphaMode": "OPAQUE",
        "extensions": {
            "KHR_materials_transmission": {"transmissionFactor": 1, "transmissionTexture": texture(0)},
            "KHR_materials_volume": {
                "thicknessFactor": 1, "thicknessTexture": texture(0), "attenuationDistance": 2, "attenuationColor": [0.5, 0.75, 1],
            },
            "KHR_materials_ior": {"ior": 1.5},
            "KHR_materials_dispersion": {"dispersion": 0.25},
            "KHR_materials_diffuse_transmission": {
                "diffuseTransmissionFactor": 0.25, "diffuseTransmissionColorFactor": [1, 0.5, 0.5],
                "diffuseTransmissionTexture": texture(0), "diffuseTransmissionColorTexture": texture(0),
            },
        },
    }  # fmt: skip
    measured = {"name": "measured", "alphaMode": "BLEND", "extras": {"reflectance_spectrum": {"nm": [400, 700], "value": [0.25, 0.75]}}}
    lamp = {"name": "lamp", "emissiveFactor": [1, 1, 1], "extras": {"emission_spectrum": "cie:A"}}
    unlit = {"name": "unlit", "extensions": {"KHR_materials_unlit": {}}}
    return [coated, glass, measured, lamp, unlit]


def nodes():
    turned = [0, 0.6, 0, 0.8]
    return [
        {"name": "world", "children": [1, 2, 3, 4, 5, 6, 7, 8, 9], "scale": [1, 1, 1]},
        {"name": "square", "mesh": 0, "translation": [-0.5, -0.5, 0], "rotation": [0, 0, 0, 1], "scale": [1, 1, 1],
         "weights": [0.5, 0]},
        {"name": "mirrored", "mesh": 1, "matrix": [-0.1, 0, 0, 0, 0, 0.1, 0, 0, 0, 0, 0.1, 0, 1, 0, -1, 1]},
        {"name": "eye", "camera": 0, "translation": [0, 0, 3]},
        {"name": "plan", "camera": 1, "translation": [0, 0, 3]},
        {"name": "lights", "children": [10, 11], "extensions": {"KHR_lights_punctual": {"light": 0}}},
        {"name": "copies", "mesh": 2, "extensions": {"EXT_mesh_gpu_instancing": {
            "attributes": {"TRANSLATION": 0, "ROTATION": 0, "SCALE": 0, "_TINT": 0}}}},
        {"name": "hidden", "mesh": 2, "extensions": {"KHR_node_visibility": {"visible": False}}},
        {"name": "skinned", "mesh": 3, "skin": 0},
        {"name": "joint", "rotation": turned},
        {"name": "lamp", "extensions": {"KHR_lights_punctual": {"light": 1}}},
        {"name": "torch", "rotation": turned, "extensions": {"KHR_lights_punctual": {"light": 2}}},
    ]  # fmt: skip


def scene():
    b = Buffer()
    whole, quantised, skinned, targets = attributes(b)
    sparse = sparse_positions(b)
    triangles = [0, 1, 2, 0, 2, 3]
    indices = [b.accessor("SCALAR", component, triangles) for component in (UBYTE, USHORT, UINT)]
    times, angles = b.accessor("SCALAR", FLOAT, [0, 1], min=[0], max=[1]), b.accessor("VEC4", FLOAT, [0, 0, 0, 1] * 2)
    inverse_bind = b.accessor("MAT4", FLOAT, [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1] * 2)
    tree = nodes()
    tree[6]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {
        "TRANSLATION": b.accessor("VEC3", FLOAT, [-1, 0, -2, 0, 0, -2, 1, 0, -2]),
        "ROTATION": b.accessor("VEC4", SHORT, [0, 0, 0, 32767] * 3, normalized=True),
        "SCALE": b.accessor("VEC3", FLOAT, [1, 1, 1, 0.5, 0.5, 0.5, 1, 1, -1]),
        "_TINT": b.accessor("SCALAR", FLOAT, [1, 2, 3]),
    }
    pixels = bytes([255, 128, 0, 255, 0, 128, 255, 64, 255, 255, 255, 255, 0, 0, 0, 0])
    image_view = b.view(png(2, 2, pixels))
    result = {
        "asset": {"version": "2.0", "minVersion": "2.0", "generator": "all_features.py"},
        "extensionsUsed": [],
        "extensionsRequired": ["KHR_mesh_quantization"],
        "scene": 1,
        "scenes": [{"name": "empty", "nodes": []}, {"name": "all", "nodes": [0]}],
        "nodes": tree,
        "meshes": [
            {"name": "square", "weights": [0.25, 0], "primitives": [
                {"attributes": whole, "indices": indices[0], "material": 0, "mode": 4, "targets": targets}]},
            {"name": "quantised", "primitives": [
                {"attributes": quantised, "indices": indices[1], "material": 1},
                {"attributes": quantised, "material": 3, "mode": 5},
                {"attributes": quantised, "material": 3, "mode": 6},
                {"attributes": {"POSITION": quantised["POSITION"]}, "mode": 0}]},
            {"name": "sparse", "primitives": [{"attributes": {"POSITION": sparse}, "indices": indices[2], "material": 2}]},
            {"name": "skinned", "primitives": [{"attributes": skinned, "indices": indices[0], "material": 4}]},
        ],
        "skins": [{"joints": [0, 9], "skeleton": 0, "inverseBindMatrices": inverse_bind}],
        "materials": materials(),
        "textures": [
            {"name": "both", "source": 0, "sampler": 0,
             "extensions": {"EXT_texture_webp": {"source": 1}, "KHR_texture_basisu": {"source": 1}}},
            {"source": 1, "sampler": 1},
        ],
        "samplers": [{"magFilter": 9728, "minFilter": 9987, "wrapS": 33071, "wrapT": 33648}, {"wrapS": 10497}],
        "images": [
            {"bufferView": image_view, "mimeType": "image/png", "name": "in the buffer"},
            {"uri": "data:image/png;base64," + base64.b64encode(png(1, 1, pixels[:4])).decode(), "mimeType": "image/png"},
        ],
        "cameras": [
            {"name": "eye", "type": "perspective", "perspective": {"yfov": 0.7, "aspectRatio": 1.5, "znear": 0.1, "zfar": 100},
             "extras": {"resolution": [12, 8]}},
            {"name": "plan", "type": "orthographic", "orthographic": {"xmag": 2, "ymag": 2, "znear": 0.1, "zfar": 100}},
        ],
        "animations": [{"name": "turn",
                        "channels": [{"sampler": 0, "target": {"node": 9, "path": "rotation"}}],
                        "samplers": [{"input": times, "output": angles, "interpolation": "LINEAR"}]}],
        "extensions": {"KHR_lights_punctual": {"lights": [
            {"name": "sun", "type": "directional", "color": [1, 0.9, 0.8], "intensity": 2},
            {"name": "bulb", "type": "point", "intensity": 3, "range": 10},
            {"name": "torch", "type": "spot", "intensity": 3, "spot": {"innerConeAngle": 0.1, "outerConeAngle": 0.5},
             "extras": {"emission_spectrum": "cie:FL11"}},
        ]}},
        "accessors": b.accessors,
        "bufferViews": b.views,
    }  # fmt: skip
    uri = "data:application/octet-stream;base64," + base64.b64encode(b.data).decode()
    result["buffers"] = [{"byteLength": len(b.data), "uri": uri}]
    result["extensionsUsed"] = sorted(set(used_extensions(result)) | {"KHR_mesh_quantization"})
    return result


def used_extensions(value):
    if isinstance(value, list):
        for element in value:
            yield from used_extensions(element)
    elif isinstance(value, dict):
        yield from value.get("extensions", {})
        for element in value.values():
            yield from used_extensions(element)


if __name__ == "__main__":
    path = pathlib.Path(__file__).with_suffix(".gltf")
    path.write_text(json.dumps(scene(), indent=1) + "\n")
