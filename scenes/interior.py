#!/usr/bin/env python3
"""Writes interior/: a room by day, its windows to the left, and interior/sky.hdr, a morning sky with a low sun over hills:

    photopic render scenes/interior/scene.glb --environment scenes/interior/sky.hdr -o interior.png

In the corner burns a floor lamp with the spectrum of a white LED (CIE LED-B1). Of our own making; the sky is no measured one: a blue
that pales towards the horizon, and a sun four degrees wide.
"""

import math
import pathlib
import random

from gltf_writer import Scene, hdr, lambert, lamp, png, product, turned
from patterns import mix, noise, painting, parquet, weave, wood
from shapes import cuboid, lathe, rod, sphere

FOLDER = pathlib.Path(__file__).parent / "interior"
LEFT, RIGHT, BACK, FRONT, HIGH, WALL = -2.3, 2.1, -2.5, 2.9, 2.7, 0.25  # [m]
WINDOWS = [(-1.75, -0.45), (0.35, 1.65)]  # along z
SILL, LINTEL = 0.75, 2.35
SUN = (-0.80, 0.50, -0.22)  # towards it
SUN_RADIUS, SUN_LUMINANCE, SKY_LUMINANCE = math.radians(2), 8500, 6.5  # [cd/m2]
GLOBE = 4.0  # luminance of the floor lamp [cd/m2]


def sky(direction):
    """Linear sRGB [cd/m2]."""
    x, y, z = direction
    azimuth = math.atan2(x, -z)
    hill = 0.07 + 0.06 * math.sin(3 * azimuth + 1) + 0.03 * math.sin(7 * azimuth)
    if y < hill:
        wood_tone = 0.7 + 0.6 * noise(40 * (azimuth / math.pi + 1), 60 * (y + 1), 80, 1000, 5)
        return tuple(SKY_LUMINANCE * wood_tone * c for c in ((0.10, 0.13, 0.05) if y > -0.05 else (0.16, 0.20, 0.09)))
    unit = math.hypot(*SUN)
    to_sun = math.acos(min(1, sum(a * b / unit for a, b in zip(direction, SUN))))
    blue = mix((1.0, 0.97, 0.90), (0.30, 0.52, 1.0), min(1, 1.6 * max(y, 0)) ** 0.6)
    glow = 1 + 1.5 * math.exp(-((to_sun / 0.35) ** 2))
    sun = SUN_LUMINANCE if to_sun < SUN_RADIUS else 0
    return tuple(SKY_LUMINANCE * glow * c + sun * s for c, s in zip(blue, (1.0, 0.86, 0.66)))


def textured(scene, name, size, pattern, roughness, **more):
    image = png(size, size, lambda x, y: pattern((x + 0.5) / size, (y + 0.5) / size))
    return scene.material({"name": name, "pbrMetallicRoughness": {
        "baseColorTexture": scene.texture(image), "metallicFactor": 0, "roughnessFactor": roughness}, **more})


def plain(name, color, roughness, metallic=0, **more):
    return {"name": name, "pbrMetallicRoughness": {
        "baseColorFactor": [*color, 1], "metallicFactor": metallic, "roughnessFactor": roughness}, **more}


def cuboids(scene, name, material, boxes, **more):
    scene.quads(name, material, [face for box in boxes for face in cuboid(*box)], **more)


def add_room(scene, white):
    plaster = scene.material(lambert("plaster", (0.80, 0.77, 0.71)))
    scene.quads("floor", textured(scene, "parquet", 512, parquet, 0.3), [[(LEFT, 0, FRONT), (RIGHT, 0, FRONT), (RIGHT, 0, BACK), (LEFT, 0, BACK)]], tile=1.5)
    scene.quads("ceiling", plaster, [[(LEFT, HIGH, BACK), (RIGHT, HIGH, BACK), (RIGHT, HIGH, FRONT), (LEFT, HIGH, FRONT)]])
    scene.quads("back wall", scene.material(lambert("sage", (0.42, 0.50, 0.40))), [[(LEFT, 0, BACK), (RIGHT, 0, BACK), (RIGHT, HIGH, BACK), (LEFT, HIGH, BACK)]])
    scene.quads("walls", plaster, [[(RIGHT, 0, BACK), (RIGHT, 0, FRONT), (RIGHT, HIGH, FRONT), (RIGHT, HIGH, BACK)],
                                   [(RIGHT, 0, FRONT), (LEFT, 0, FRONT), (LEFT, HIGH, FRONT), (RIGHT, HIGH, FRONT)]])
    edges = [BACK - WALL, *(z for window in WINDOWS for z in window), FRONT + WALL]
    outer = LEFT - WALL
    pieces = [((outer, -WALL, a), (LEFT, HIGH + WALL, b)) for a, b in zip(edges[::2], edges[1::2])]
    pieces += [((outer, low, a), (LEFT, high, b)) for a, b in WINDOWS for low, high in ((-WALL, SILL), (LINTEL, HIGH + WALL))]
    cuboids(scene, "window wall", plaster, pieces)
    frames, x0, x1 = [], LEFT - 0.17, LEFT - 0.12
    for a, b in WINDOWS:
        for c in (a, (a + b) / 2 - 0.03, b - 0.06):
            frames.append(((x0, SILL, c), (x1, LINTEL, c + 0.06)))
        for y in (SILL, SILL + 1.0, LINTEL - 0.06):
            frames.append(((x0 + 0.005, y, a), (x1 - 0.005, y + 0.06, b)))
        frames.append(((LEFT - 0.2, SILL - 0.04, a - 0.06), (LEFT + 0.06, SILL + 0.001, b + 0.06)))
    cuboids(scene, "frames", white, frames)
    skirting = [((LEFT, 0, BACK), (RIGHT, 0.11, BACK + 0.02)), ((RIGHT - 0.02, 0, BACK), (RIGHT, 0.11, FRONT)), ((LEFT, 0, BACK), (LEFT + 0.02, 0.11, FRONT))]
    cuboids(scene, "skirting", white, skirting)


def add_picture(scene, oak):
    x, y, z, w, h = -0.62, 1.62, BACK + 0.03, 0.5, 0.36
    scene.quads("picture", textured(scene, "painting", 256, painting, 0.5), [[(x - w, y - h, z), (x + w, y - h, z), (x + w, y + h, z), (x - w, y + h, z)]],
                uvs=[(0, 1), (1, 1), (1, 0), (0, 0)])
    t = 0.05
    bars = [((x - w - t, y + h, BACK + 0.001), (x + w + t, y + h + t, z + 0.02)), ((x - w - t, y - h - t, BACK + 0.001), (x + w + t, y - h, z + 0.02)),
            ((x - w - t, y - h, BACK + 0.001), (x - w, y + h, z + 0.02)), ((x + w, y - h, BACK + 0.001), (x + w + t, y + h, z + 0.02))]
    cuboids(scene, "picture frame", oak, bars, tile=0.8)


def add_books(scene, oak):
    """A bookcase in the right back corner."""
    numbers = random.Random(4)
    x0, x1, z0, z1, shelf, board = 0.85, 1.95, BACK + 0.01, BACK + 0.31, 0.36, 0.025
    levels = [0.08 + shelf * k for k in range(6)]
    boxes = [((x0, 0, z0), (x0 + board, levels[-1] + board, z1)), ((x1 - board, 0, z0), (x1, levels[-1] + board, z1))]
    boxes += [((x0 + board, y, z0), (x1 - board, y + board, z1)) for y in levels]
    cuboids(scene, "bookcase", oak, boxes, tile=0.9)
    colors = [(0.42, 0.06, 0.05), (0.05, 0.11, 0.30), (0.08, 0.24, 0.14), (0.62, 0.46, 0.16), (0.66, 0.62, 0.52), (0.13, 0.10, 0.10), (0.55, 0.22, 0.08), (0.25, 0.32, 0.42)]
    books = [[] for _ in colors]
    for y in levels[:-1]:
        x = x0 + board + 0.003
        while x < x1 - board - (0.05 if y != levels[2] else 0.45):
            thick, high, deep = numbers.uniform(0.018, 0.045), numbers.uniform(0.19, 0.3), numbers.uniform(0.15, 0.22)
            books[numbers.randrange(len(colors))].append(((x, y + board, z0 + 0.02), (x + thick, y + board + high, z0 + 0.02 + deep)))
            x += thick + 0.002
    for i, (color, boxes) in enumerate(zip(colors, books)):
        cuboids(scene, f"books {i}", scene.material(plain(f"cloth {i}", color, 0.7)), boxes)


def add_table(scene, oak, x, z):
    top = [(0, 0.74, 0, 1), (0.60, 0.74, 0, 1), (0.605, 0.735, 1, 0), (0.605, 0.705, 1, 0), (0.60, 0.70, 0, -1), (0, 0.70, 0, -1)]
    positions, triangles, normals = lathe(top)
    scene.mesh("table top", oak, positions, triangles, normals, uvs=[(p[0], p[2]) for p in positions], translation=[x, 0, z])
    foot = [(0.28, 0.0, 1, 0), (0.27, 0.03, 0.5, 0.8), (0.06, 0.07, 0.8, 0.5), (0.045, 0.3, 1, 0), (0.055, 0.6, 1, 0), (0.12, 0.70, 0.8, -0.5)]
    positions, triangles, normals = lathe(foot)
    scene.mesh("table foot", oak, positions, triangles, normals, uvs=[(p[1], 0.3 * math.atan2(p[2], p[0])) for p in positions], translation=[x, 0.001, z])

    bowl = [(0.05, 0.0, 0.3, -0.9), (0.13, 0.03, 0.7, -0.7), (0.18, 0.09, 0.95, -0.3), (0.185, 0.095, 0, 1), (0.175, 0.09, -0.95, 0.3), (0.12, 0.04, -0.7, 0.7), (0, 0.02, 0, 1)]
    positions, triangles, normals = lathe(bowl)
    scene.mesh("bowl", scene.material(plain("glaze", (0.10, 0.24, 0.42), 0.12, doubleSided=True)), positions, triangles, normals, translation=[x + 0.05, 0.742, z + 0.05])
    orange, lemon = scene.material(plain("orange", (0.85, 0.28, 0.02), 0.4)), scene.material(plain("lemon", (0.85, 0.62, 0.06), 0.4))
    positions, triangles, normals = sphere(0.055, 16, 32)
    for dx, dy, dz, fruit in ((0.0, 0.078, 0.06, orange), (-0.06, 0.08, -0.02, orange), (0.06, 0.08, -0.03, lemon), (0.0, 0.155, 0.005, orange)):
        scene.mesh("fruit", fruit, positions, triangles, normals, translation=[x + 0.05 + dx, 0.742 + dy, z + 0.05 + dz])
    cuboids(scene, "lying book", scene.material(plain("red cloth", (0.45, 0.05, 0.06), 0.6)), [((-0.11, 0, -0.08), (0.11, 0.03, 0.08))],
            translation=[x - 0.27, 0.742, z + 0.2], rotation=turned((0, 1, 0), 23))


def add_chair(scene, oak, x, z, degrees):
    """Its back towards −z before it is turned."""
    legs = [((sx * 0.2 - 0.02, 0, sz * 0.2 - 0.02), (sx * 0.2 + 0.02, 0.92 if sz < 0 else 0.44, sz * 0.2 + 0.02)) for sx in (-1, 1) for sz in (-1, 1)]
    slats = [((-0.18, y, -0.215), (0.18, y + 0.07, -0.195)) for y in (0.58, 0.7, 0.82)]
    rails = [((-0.2, 0.2, sz * 0.2 - 0.01), (0.2, 0.23, sz * 0.2 + 0.01)) for sz in (-1, 1)]
    cuboids(scene, "chair", oak, [((-0.23, 0.44, -0.22), (0.23, 0.47, 0.23)), *legs, *slats, *rails], tile=0.7,
            translation=[x, 0.001, z], rotation=turned((0, 1, 0), degrees))


def add_lamp(scene, x, z):
    brass = scene.material(plain("brass", (0.85, 0.68, 0.35), 0.35, metallic=1))
    positions, triangles, normals = rod((0, 0, 0), (0, 1.45, 0), 0.012, 16)
    scene.mesh("stand", brass, positions, triangles, normals, translation=[x, 0, z])
    positions, triangles, normals = lathe([(0.16, 0.0, 1, 0), (0.15, 0.02, 0.5, 0.8), (0.012, 0.03, 0, 1)])
    scene.mesh("stand's foot", brass, positions, triangles, normals, translation=[x, 0.001, z])
    positions, triangles, normals = sphere(0.16, 16, 32)
    scene.mesh("globe", scene.material(lamp("globe", 0.7, GLOBE, "cie:LED-B1")), positions, triangles, normals, translation=[x, 1.6, z])


def main():
    FOLDER.mkdir(exist_ok=True)
    (FOLDER / "sky.hdr").write_bytes(hdr(256, 128, sky))
    scene = Scene("Photopic's authors")
    white = scene.material(plain("white lacquer", (0.8, 0.8, 0.78), 0.35))
    oak = textured(scene, "oak", 512, wood, 0.4)
    add_room(scene, white)
    add_picture(scene, oak)
    add_books(scene, oak)
    x, z = -0.35, -0.75
    rug = lambda u, v: weave(u, v, one=(0.16, 0.24, 0.42), other=(0.78, 0.72, 0.60))
    cuboids(scene, "rug", textured(scene, "rug", 256, rug, 1.0), [((x - 1.15, 0.002, z - 0.95), (x + 1.25, 0.014, z + 1.15))], tile=0.8)
    add_table(scene, oak, x, z)
    add_chair(scene, oak, x + 0.72, z + 0.35, -105)
    add_chair(scene, oak, x - 0.25, z - 0.78, 12)
    add_lamp(scene, 0.45, BACK + 0.35)

    velvet = plain("velvet", (0.50, 0.10, 0.07), 0.9)
    velvet["extensions"] = {"KHR_materials_sheen": {"sheenColorFactor": [0.5, 0.25, 0.2], "sheenRoughnessFactor": 0.4}}
    positions, triangles, normals = sphere(0.3, 32, 64)
    scene.mesh("pouf", scene.material(velvet), positions, triangles, normals, translation=[1.15, 0.212, -0.35], scale=[1, 0.7, 1])

    scene.camera(math.radians(46), [480, 320], translation=[0.55, 1.45, 2.75],
                 rotation=product(turned((0, 1, 0), 9), turned((1, 0, 0), -8)))
    scene.write_glb(FOLDER / "scene.glb")


if __name__ == "__main__":
    main()
