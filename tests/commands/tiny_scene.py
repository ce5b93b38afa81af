"""A scene of three squares: a grey floor, a red wall and a lamp above them; glTF with its buffer inside."""

import base64
import json
import struct

# Corners, counter-clockwise seen from the side that is lit.
FLOOR = [(-1, 0, 1), (1, 0, 1), (1, 0, -1), (-1, 0, -1)]
WALL = [(-1, 0, -1), (1, 0, -1), (1, 2, -1), (-1, 2, -1)]
LAMP = [(-0.4, 1.9, -0.4), (0.4, 1.9, -0.4), (0.4, 1.9, 0.4), (-0.4, 1.9, 0.4)]


def material(name, color, emission=None):
    result = {
        "name": name,
        "doubleSided": True,
        "pbrMetallicRoughness": {"baseColorFactor": color + [1.0], "metallicFactor": 0.0},
    }
    if emission:
        result["emissiveFactor"] = [1.0, 1.0, 1.0]
        result["extensions"] = {"KHR_materials_emissive_strength": {"emissiveStrength": emission}}
    return result


def tiny_scene(emission=5.0):
    squares = [FLOOR, WALL, LAMP]
    positions = b"".join(struct.pack("<3f", *corner) for square in squares for corner in square)
    indices = struct.pack("<6H", 0, 1, 2, 0, 2, 3)
    data = positions + indices
    accessors = [
        {
            "bufferView": 0,
            "byteOffset": 48 * i,
            "componentType": 5126,
            "count": 4,
            "type": "VEC3",
            "min": [min(c[axis] for c in square) for axis in range(3)],
            "max": [max(c[axis] for c in square) for axis in range(3)],
        }
        for i, square in enumerate(squares)
    ]
    accessors.append({"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"})
    return {
        "asset": {"version": "2.0"},
        "extensionsUsed": ["KHR_materials_emissive_strength"] if emission else [],
        "scene": 0,
        "scenes": [{"nodes": [0, 1]}],
        "nodes": [{"mesh": 0}, {"camera": 0, "translation": [0, 1, 4]}],
        "cameras": [
            {
                "type": "perspective",
                "perspective": {"yfov": 0.6, "znear": 0.1, "aspectRatio": 1.0},
                "extras": {"resolution": [32, 32]},
            }
        ],
        "meshes": [
            {"primitives": [{"attributes": {"POSITION": i}, "indices": 3, "material": i} for i in range(3)]}
        ],
        "materials": [
            material("floor", [0.7, 0.7, 0.7]),
            material("wall", [0.6, 0.1, 0.05]),
            material("lamp", [0.0, 0.0, 0.0], emission),
        ],
        "accessors": accessors,
        "bufferViews": [
            {"buffer": 0, "byteOffset": 0, "byteLength": len(positions)},
            {"buffer": 0, "byteOffset": len(positions), "byteLength": len(indices)},
        ],
        "buffers": [
            {
                "byteLength": len(data),
                "uri": "data:application/octet-stream;base64," + base64.b64encode(data).decode(),
            }
        ],
    }


def write_tiny_scene(path, emission=5.0):
    scene = tiny_scene(emission)
    if not scene["extensionsUsed"]:
        del scene["extensionsUsed"]
    path.write_text(json.dumps(scene))
    return path
