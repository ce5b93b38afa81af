#!/usr/bin/env python3
"""Writes a large .glb for measuring how long loading takes and how much memory.

  make_large_scene.py FILE.glb [--triangles N] [--nodes M] [--instances]

About N triangles in all, on M waves with normals and texture coordinates; with --instances the M nodes share one mesh.
"""

import argparse
import json
import math
import struct
from array import array


def wave(triangles):
    """A square of cells² · 2 triangles: positions, normals, texture coordinates and indices."""
    cells = max(1, round(math.sqrt(triangles / 2)))
    positions, normals, uvs, indices = array("f"), array("f"), array("f"), array("I")
    for y in range(cells + 1):
        for x in range(cells + 1):
            u, v = x / cells, y / cells
            positions.extend((u, 0.05 * math.sin(20 * u) * math.cos(20 * v), v))
            slope_x = math.cos(20 * u) * math.cos(20 * v)
            slope_z = -math.sin(20 * u) * math.sin(20 * v)
            length = math.sqrt(1 + slope_x**2 + slope_z**2)
            normals.extend((-slope_x / length, 1 / length, -slope_z / length))
            uvs.extend((u, v))
    for y in range(cells):
        for x in range(cells):
            a = y * (cells + 1) + x
            indices.extend((a, a + cells + 1, a + 1, a + 1, a + cells + 1, a + cells + 2))
    return positions, normals, uvs, indices


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("file")
    parser.add_argument("--triangles", type=int, default=1_000_000)
    parser.add_argument("--nodes", type=int, default=1)
    parser.add_argument("--instances", action="store_true")
    arguments = parser.parse_args()

    chunk, views, accessors = bytearray(), [], []

    def add(data, kind):
        """An accessor over the data. Returns its index."""
        size = {"SCALAR": 1, "VEC2": 2, "VEC3": 3}[kind]
        views.append({"buffer": 0, "byteOffset": len(chunk), "byteLength": len(data) * data.itemsize})
        component = 5125 if data.typecode == "I" else 5126
        count = len(data) // size
        accessors.append(
            {"bufferView": len(accessors), "componentType": component, "count": count, "type": kind}
        )
        chunk.extend(data.tobytes())
        return len(accessors) - 1

    for data, kind in zip(wave(arguments.triangles / arguments.nodes), ("VEC3", "VEC3", "VEC2", "SCALAR")):
        add(data, kind)
    primitive = {"attributes": {"POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2}, "indices": 3}
    materials = [{"name": f"paint {i}", "pbrMetallicRoughness": {"metallicFactor": 0}} for i in range(4)]
    meshes = [{"primitives": [primitive | {"material": i}]} for i in range(len(materials))]
    side = math.ceil(math.sqrt(arguments.nodes))
    nodes = []
    for i in range(arguments.nodes):
        mesh = 0 if arguments.instances else i % len(meshes)
        nodes.append({"mesh": mesh, "translation": [i % side - side / 2, 0, i // side - side / 2]})
    nodes.append({"camera": 0, "translation": [0, 0.7 * side, 1.2 * side], "rotation": [-0.26, 0, 0, 0.966]})
    materials.append({"name": "lamp", "doubleSided": True, "emissiveFactor": [1, 1, 1]})
    lamp = {"attributes": {"POSITION": add(array("f", (0, 0, 0, 1, 0, 0, 0, 0, 1)), "VEC3")}}
    meshes.append({"primitives": [lamp | {"material": len(materials) - 1}]})
    nodes.append({"mesh": len(meshes) - 1, "translation": [0, 5, 0], "scale": [side, 1, side]})

    scene = {
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": list(range(len(nodes)))}],
        "nodes": nodes,
        "meshes": meshes,
        "materials": materials,
        "cameras": [{"type": "perspective", "perspective": {"yfov": 0.8}}],
        "accessors": accessors,
        "bufferViews": views,
        "buffers": [{"byteLength": len(chunk)}],
    }
    text = json.dumps(scene, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    with open(arguments.file, "wb") as out:
        out.write(struct.pack("<4sII", b"glTF", 2, 20 + len(text) + 8 + len(chunk)))
        out.write(struct.pack("<I4s", len(text), b"JSON") + text)
        out.write(struct.pack("<I4s", len(chunk), b"BIN\0") + chunk)


if __name__ == "__main__":
    main()
