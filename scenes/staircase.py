#!/usr/bin/env python3
"""Writes staircase/scene.glb: wooden stairs in a hall with a parquet floor, a carpet, pictures, a chest, a plant and much else, under one
lamp. Of our own making. The lamp is a paper globe with the spectrum of a white LED (CIE LED-B3)."""

import math
import pathlib
import random

from gltf_writer import Scene, lambert, lamp, png, product, turned
from patterns import painting, parquet, weave, wood
from shapes import cuboid, lathe, rod, sphere

FOLDER = pathlib.Path(__file__).parent / "staircase"
STEPS, RISE, RUN, NOSE = 14, 0.175, 0.27, 0.03
STAIR_WIDTH, STAIR_Z = 1.1, -2.0  # along the back wall, upwards to the right
START = -1.2  # x of the first riser
GLOBE, LUMINANCE = 0.26, 56  # the globe's radius and luminance [cd/m2]


def textured(scene, name, size, pattern, roughness):
    image = png(size, size, lambda x, y: pattern((x + 0.5) / size, (y + 0.5) / size))
    return scene.material({"name": name, "pbrMetallicRoughness": {
        "baseColorTexture": scene.texture(image), "metallicFactor": 0, "roughnessFactor": roughness}})


def add_hall(scene):
    left, right, front, back, high = -3.0, 3.2, 4.2, STAIR_Z - STAIR_WIDTH / 2, 3.4
    paint = scene.material(lambert("paint", (0.78, 0.76, 0.71)))
    green = scene.material(lambert("green paint", (0.35, 0.45, 0.38)))
    scene.quads("floor", textured(scene, "parquet", 512, parquet, 0.35),
                [[(left, 0, front), (right, 0, front), (right, 0, back), (left, 0, back)]], tile=1.6)
    scene.quads("walls", paint, [
        [(left, 0, back), (right, 0, back), (right, high, back), (left, high, back)],
        [(right, 0, front), (left, 0, front), (left, high, front), (right, high, front)],
        [(right, 0, back), (right, 0, front), (right, high, front), (right, high, back)],
        [(left, high, back), (right, high, back), (right, high, front), (left, high, front)]])
    scene.quads("left wall", green, [[(left, 0, front), (left, 0, back), (left, high, back), (left, high, front)]])
    scene.quads("carpet", textured(scene, "carpet", 256, weave, 1.0), cuboid((-1.9, 0.002, 0.2), (0.7, 0.012, 1.9)), tile=0.65)

    add_panelling(scene, left, right, back)


def add_panelling(scene, left, right, back):
    """Skirting boards and a rail along the back and the left wall."""
    white = scene.material({"name": "skirting", "pbrMetallicRoughness": {
        "baseColorFactor": [0.8, 0.8, 0.77, 1], "metallicFactor": 0, "roughnessFactor": 0.4}})
    bars = []
    for low, high, deep in ((0, 0.14, 0.02), (0.92, 0.98, 0.03)):
        bars += cuboid((left, low, back), (START - 0.02, high, back + deep)) + cuboid((left, low, back), (left + deep, high, 4.2))
    bars += cuboid((right - 0.02, 0, back), (right, 0.14, 4.2))
    scene.quads("panelling", white, bars)


def add_pictures(scene):
    """One on the left wall and four that climb with the stairs."""
    image = textured(scene, "painting", 256, painting, 0.6)
    frame = scene.material({"name": "gilt", "pbrMetallicRoughness": {
        "baseColorFactor": [0.8, 0.58, 0.25, 1], "metallicFactor": 1, "roughnessFactor": 0.45}})
    back = STAIR_Z - STAIR_WIDTH / 2
    to_right = turned((0, 1, 0), 90)
    places = [((-3.0, 1.75, 1.0), to_right, 0.55, 0.4, (0, 0, 1, 1)), ((-1.85, 1.8, back), [0, 0, 0, 1], 0.4, 0.3, (0.1, 0.1, 0.9, 0.9))]
    places += [((-0.75 + 0.95 * k, 1.95 + 0.45 * k, back), [0, 0, 0, 1], 0.2, 0.26, (0.2 * k, 0.3, 0.2 * k + 0.4, 0.8)) for k in range(3)]
    for middle, rotation, w, h, (u0, v0, u1, v1) in places:
        scene.quads("picture", image, [[(-w, -h, 0.03), (w, -h, 0.03), (w, h, 0.03), (-w, h, 0.03)]],
                    uvs=[(u0, v1), (u1, v1), (u1, v0), (u0, v0)], translation=list(middle), rotation=rotation)
        t = 0.16 * h
        bars = [((-w - t, h, 0.001), (w + t, h + t, 0.05)), ((-w - t, -h - t, 0.001), (w + t, -h, 0.05)),
                ((-w - t, -h, 0.001), (-w, h, 0.05)), ((w, -h, 0.001), (w + t, h, 0.05))]
        scene.quads("frame", frame, [face for bar in bars for face in cuboid(*bar)], translation=list(middle), rotation=rotation)


def add_stairs(scene, oak):
    white = scene.material({"name": "white lacquer", "pbrMetallicRoughness": {
        "baseColorFactor": [0.8, 0.8, 0.77, 1], "metallicFactor": 0, "roughnessFactor": 0.25}})
    iron = scene.material({"name": "iron", "pbrMetallicRoughness": {
        "baseColorFactor": [0.03, 0.03, 0.03, 1], "metallicFactor": 0, "roughnessFactor": 0.45}})
    front, back = STAIR_Z + STAIR_WIDTH / 2, STAIR_Z - STAIR_WIDTH / 2
    for i in range(STEPS):
        x, y = START + i * RUN, (i + 1) * RISE
        scene.quads(f"riser {i}", white, cuboid((x, 0 if i == 0 else y - 2 * RISE, back), (x + RUN + 0.02, y - 0.03, front - 0.02)))
        scene.quads(f"tread {i}", oak, cuboid((x - NOSE, y - 0.03, back), (x + RUN + 0.02, y, front)), tile=0.9 + 0.01 * i)
        for part in (0.25, 0.75):
            bx = x + part * RUN
            positions, triangles, normals = rod((bx, y, front - 0.05), (bx, y + 0.9 + part * RISE, front - 0.05), 0.012)
            scene.mesh("baluster", iron, positions, triangles, normals)
    run, rise = STEPS * RUN, STEPS * RISE
    positions, triangles, normals = rod((START - 0.1, 0.98 + RISE * 0.7, front - 0.05), (START + run, 0.98 + RISE * 0.7 + rise * (run + 0.1) / run, front - 0.05), 0.03, 24)
    scene.mesh("handrail", oak, positions, triangles, normals, uvs=[(0.5 * p[0], 0.5 * math.atan2(n[1], n[2])) for p, n in zip(positions, normals)])


def add_things(scene):
    glaze = scene.material({"name": "blue glaze", "pbrMetallicRoughness": {
        "baseColorFactor": [0.05, 0.16, 0.45, 1], "metallicFactor": 0, "roughnessFactor": 0.08}})
    profile = []
    for k in range(33):
        t = k / 32
        radius = 0.14 + 0.10 * math.sin(math.pi * (0.15 + 0.95 * t)) - 0.06 * t
        slope = 0.10 * math.pi * 0.95 * math.cos(math.pi * (0.15 + 0.95 * t)) - 0.06
        length = math.hypot(0.62, slope)
        profile.append((radius, 0.62 * t, 0.62 / length, -slope / length))
    positions, triangles, normals = lathe(profile)
    scene.mesh("vase", glaze, positions, triangles, normals, translation=[2.15, 0, -0.1])

    positions, triangles, normals = sphere(0.16, 32, 64)
    copper = scene.material({"name": "copper", "extras": {"conductor": "Cu"},
                             "pbrMetallicRoughness": {"metallicFactor": 1, "roughnessFactor": 0.3}})
    scene.mesh("ball", copper, positions, triangles, normals, translation=[1.05, 0.161, 0.95])

    globe, triangles, normals = sphere(GLOBE, 16, 32)
    x, y, z = -1.35, 2.3, 0.2
    scene.mesh("globe", scene.material(lamp("globe", 0.8, LUMINANCE, "cie:LED-B3")), globe, triangles, normals, translation=[x, y, z])
    cord, triangles, normals = rod((x, y + GLOBE, z), (x, 3.4, z), 0.008, 8)
    scene.mesh("cord", scene.material(lambert("cord", (0.05, 0.05, 0.05))), cord, triangles, normals)


def add_chest(scene, oak):
    """Under the stairs, with books and a bowl on it."""
    x0, x1, z0, z1, high = 1.0, 1.9, -1.3, -0.8, 0.5
    boards = cuboid((x0, 0.06, z0), (x1, high - 0.05, z1)) + cuboid((x0 - 0.03, high - 0.048, z0), (x1 + 0.03, high, z1 + 0.03))
    for x in (x0 + 0.02, x1 - 0.08):
        for z in (z0 + 0.02, z1 - 0.08):
            boards += cuboid((x, 0, z), (x + 0.06, 0.062, z + 0.06))
    scene.quads("chest", oak, boards, tile=0.8)
    numbers = random.Random(3)
    for i, color in enumerate([(0.45, 0.07, 0.05), (0.06, 0.14, 0.33), (0.62, 0.45, 0.14), (0.10, 0.27, 0.16)]):
        cloth = scene.material({"name": f"book {i}", "pbrMetallicRoughness": {
            "baseColorFactor": [*color, 1], "metallicFactor": 0, "roughnessFactor": 0.6}})
        scene.quads(f"book {i}", cloth, cuboid((-0.13, 0, -0.09), (0.13, 0.034, 0.09)), translation=[x0 + 0.25, high + 0.001 + 0.036 * i, z1 - 0.22],
                    rotation=turned((0, 1, 0), numbers.uniform(-23, 23)))
    bowl = [(0.05, 0.0, 0.3, -0.9), (0.13, 0.03, 0.7, -0.7), (0.18, 0.09, 0.95, -0.3), (0.185, 0.095, 0, 1), (0.175, 0.09, -0.95, 0.3),
            (0.12, 0.04, -0.7, 0.7), (0, 0.02, 0, 1)]
    positions, triangles, normals = lathe(bowl)
    clay = scene.material({"name": "clay", "doubleSided": True, "pbrMetallicRoughness": {
        "baseColorFactor": [0.62, 0.30, 0.16, 1], "metallicFactor": 0, "roughnessFactor": 0.5}})
    scene.mesh("bowl", clay, positions, triangles, normals, translation=[x1 - 0.3, high + 0.001, z1 - 0.22])


def add_plant(scene):
    """Blades that rise from a pot and bend outwards."""
    x, z = -2.35, -1.75
    pot = [(0, 0.002, 0, -1), (0.15, 0.002, 0.4, -0.9), (0.2, 0.34, 1, -0.1), (0.215, 0.35, 0, 1), (0.18, 0.33, 0, 1), (0, 0.32, 0, 1)]
    positions, triangles, normals = lathe(pot)
    terracotta = scene.material({"name": "terracotta", "pbrMetallicRoughness": {
        "baseColorFactor": [0.48, 0.19, 0.10, 1], "metallicFactor": 0, "roughnessFactor": 0.8}})
    scene.mesh("pot", terracotta, positions, triangles, normals, translation=[x, 0, z])
    numbers, quads, joints = random.Random(5), [], 8
    for _ in range(46):
        phi, reach, rise = numbers.uniform(0, 2 * math.pi), numbers.uniform(0.15, 0.55), numbers.uniform(0.6, 1.15)
        spine = [(reach * (t / joints) ** 2, 0.32 + rise * (t / joints) * (1.25 - 0.45 * (t / joints) ** 2), 0.022 * math.sin(math.pi * (0.12 + 0.88 * t / joints)))
                 for t in range(joints + 1)]
        corner = lambda p, side: (0.05 * math.cos(phi) + p[0] * math.cos(phi) - side * p[2] * math.sin(phi), p[1],
                                  0.05 * math.sin(phi) + p[0] * math.sin(phi) + side * p[2] * math.cos(phi))
        quads += [[corner(a, -1), corner(a, 1), corner(b, 1), corner(b, -1)] for a, b in zip(spine, spine[1:])]
    leaf = scene.material({"name": "leaf", "doubleSided": True, "pbrMetallicRoughness": {
        "baseColorFactor": [0.10, 0.26, 0.06, 1], "metallicFactor": 0, "roughnessFactor": 0.5}})
    scene.quads("leaves", leaf, quads, translation=[x, 0, z])


def main():
    FOLDER.mkdir(exist_ok=True)
    scene = Scene("Photopic's authors")
    add_hall(scene)
    oak = textured(scene, "oak", 512, wood, 0.4)
    add_pictures(scene)
    add_stairs(scene, oak)
    add_things(scene)
    add_chest(scene, oak)
    add_plant(scene)
    scene.camera(math.radians(48), [400, 300], translation=[0.75, 1.45, 3.9],
                 rotation=product(turned((0, 1, 0), 8), turned((1, 0, 0), -7)))
    scene.write_glb(FOLDER / "scene.glb")


if __name__ == "__main__":
    main()
