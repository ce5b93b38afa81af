#!/usr/bin/env python3
"""Writes many-lights/scene.glb: 1,000 small lamps of three kinds in a hall with columns and a floor of polished stone.

The lamps are octahedra of 12 cm that hang on threads over a grid of 20 by 50 places, of the fluorescent, incandescent and
daylight-LED kind (CIE FL11, a blackbody at 2700 K, CIE LED-B5) in no order. Of our own making.
"""

import math
import pathlib
import random

from gltf_writer import Scene, lambert, lamp, png
from patterns import mix, noise
from shapes import cuboid, lathe

FOLDER = pathlib.Path(__file__).parent / "many-lights"
HALF, LENGTH, HIGH = 5.0, 25.0, 5.2  # half the hall's width, its length and height [m]
COLUMNS, ROWS, RADIUS = 20, 50, 0.06  # of lamps, and a lamp's radius [m]
LUMINANCE = 10  # [cd/m2]; exposes the picture well at 0 EV
LAMPS = {"tube": "cie:FL11", "bulb": "blackbody:2700", "led": "cie:LED-B5"}
OCTAHEDRON = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]
FACES = [(2, 4, 0), (2, 0, 5), (2, 5, 1), (2, 1, 4), (3, 0, 4), (3, 5, 0), (3, 1, 5), (3, 4, 1)]


def tiles(u, v, count=4):
    """Slabs of dark stone, two kinds in checks."""
    x, y = u * count, v * count
    if min(x % 1, 1 - x % 1, y % 1, 1 - y % 1) < 0.012:
        return (0.08, 0.08, 0.08)
    cloud = noise(16 * u, 16 * v, 16, 16, 1) * 0.6 + noise(64 * u, 64 * v, 64, 64, 2) * 0.4
    one, other = ((0.20, 0.21, 0.24), (0.30, 0.31, 0.34)), ((0.50, 0.49, 0.46), (0.62, 0.60, 0.56))
    return mix(*(one if (math.floor(x) + math.floor(y)) % 2 else other), cloud)


def add_hall(scene):
    stone = scene.material({"name": "stone", "pbrMetallicRoughness": {
        "baseColorTexture": scene.texture(png(256, 256, lambda x, y: tiles((x + 0.5) / 256, (y + 0.5) / 256))),
        "metallicFactor": 0, "roughnessFactor": 0.28}})
    plaster = scene.material(lambert("plaster", (0.68, 0.64, 0.58)))
    red = scene.material(lambert("red", (0.35, 0.07, 0.05)))
    scene.quads("floor", stone, [[(-HALF, 0, 0), (HALF, 0, 0), (HALF, 0, -LENGTH), (-HALF, 0, -LENGTH)]], tile=4)
    front, back, right, left, top, _ = (face[::-1] for face in cuboid((-HALF, 0, -LENGTH), (HALF, HIGH, 0)))
    scene.quads("walls", plaster, [front, right, left, top])
    scene.quads("end wall", red, [back])

    shaft = [(0.34, 0.0, 1, 0), (0.34, 0.12, 1, 0), (0.26, 0.18, 0.7, 0.7), (0.24, 0.3, 1, 0), (0.205, HIGH - 0.5, 1, 0),
             (0.25, HIGH - 0.35, 0.7, -0.7), (0.38, HIGH - 0.2, 0.7, -0.7), (0.38, HIGH, 1, 0)]
    positions, triangles, normals = lathe(shaft, sectors=48)
    for k in range(7):
        for x in (-3.4, 3.4):
            scene.mesh("column", plaster, positions, triangles, normals, translation=[x, 0.001, -2.6 - 3.3 * k])


def add_lamps(scene):
    numbers = random.Random(1)
    kinds = [name for name in LAMPS for _ in range(COLUMNS * ROWS // len(LAMPS) + 1)][:COLUMNS * ROWS]
    numbers.shuffle(kinds)
    positions, triangles = {name: [] for name in LAMPS}, {name: [] for name in LAMPS}
    for i, kind in enumerate(kinds):
        x = 2.7 * (2 * (i % COLUMNS + numbers.random()) / COLUMNS - 1)
        z = -1.6 - (LENGTH - 2.2) * (i // COLUMNS + numbers.random()) / ROWS
        y = 2.3 + 2.6 * numbers.random() ** 0.8
        first = len(positions[kind])
        positions[kind] += [(x + RADIUS * a, y + RADIUS * b, z + RADIUS * c) for a, b, c in OCTAHEDRON]
        triangles[kind] += [tuple(first + k for k in face) for face in FACES]
    for name, spectrum in LAMPS.items():
        scene.mesh(name, scene.material(lamp(name, 0, LUMINANCE, spectrum)), positions[name], triangles[name])


def main():
    FOLDER.mkdir(exist_ok=True)
    scene = Scene("Photopic's authors")
    add_hall(scene)
    add_lamps(scene)
    scene.camera(math.radians(46), [480, 300], translation=[0.35, 1.6, -0.2])
    scene.write_glb(FOLDER / "scene.glb")


if __name__ == "__main__":
    main()
