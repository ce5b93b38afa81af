#!/usr/bin/env python3
"""Writes staircase/scene.glb: wooden stairs in a hall with a parquet floor, a carpet, a picture and brass, under one lamp. Of our
own making. The lamp is a globe with the spectrum of a white LED (CIE LED-B3)."""

import math
import pathlib

from gltf_writer import Scene, lambert, lamp, png
from patterns import painting, parquet, weave, wood
from shapes import lathe, rod, sphere

FOLDER = pathlib.Path(__file__).parent / "staircase"
STEPS, RISE, RUN, NOSE = 14, 0.175, 0.27, 0.03
STAIR_WIDTH, STAIR_Z = 1.1, -2.0  # along the back wall, upwards to the right
START = -1.2  # x of the first riser
LUMINANCE = 90  # of the globe [cd/m2]


def textured(scene, name, size, pattern, roughness):
    image = png(size, size, lambda x, y: pattern((x + 0.5) / size, (y + 0.5) / size))
    return scene.material({"name": name, "pbrMetallicRoughness": {
        "baseColorTexture": scene.texture(image), "metallicFactor": 0, "roughnessFactor": roughness}})


def cuboid(low, high):
    """The six faces of an axis-aligned box, seen from outside."""
    (a, b, c), (d, e, f) = low, high
    return [[(a, b, f), (d, b, f), (d, e, f), (a, e, f)], [(d, b, c), (a, b, c), (a, e, c), (d, e, c)],
            [(d, b, f), (d, b, c), (d, e, c), (d, e, f)], [(a, b, c), (a, b, f), (a, e, f), (a, e, c)],
            [(a, e, f), (d, e, f), (d, e, c), (a, e, c)], [(a, b, c), (d, b, c), (d, b, f), (a, b, f)]]


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

    y, z, w, h = 1.75, 1.1, 0.55, 0.4  # on the left wall, seen from the right
    scene.quads("picture", textured(scene, "painting", 256, painting, 0.6),
                [[(left + 0.03, y - h, z + w), (left + 0.03, y - h, z - w), (left + 0.03, y + h, z - w), (left + 0.03, y + h, z + w)]])
    scene.json["meshes"][-1]["primitives"][0]["attributes"]["TEXCOORD_0"] = scene._accessor(
        "ff", 5126, "VEC2", [(0, 1), (1, 1), (1, 0), (0, 0)], 34962)
    frame = scene.material({"name": "gilt", "pbrMetallicRoughness": {
        "baseColorFactor": [1.0, 0.77, 0.34, 1], "metallicFactor": 1, "roughnessFactor": 0.25}})
    for y0, y1, z0, z1 in ((y + h, y + h + 0.06, z - w - 0.06, z + w + 0.06), (y - h - 0.06, y - h, z - w - 0.06, z + w + 0.06),
                           (y - h, y + h, z - w - 0.06, z - w), (y - h, y + h, z + w, z + w + 0.06)):
        scene.quads("frame", frame, cuboid((left + 0.001, y0, z0), (left + 0.05, y1, z1)))


def add_stairs(scene):
    oak = textured(scene, "oak", 512, wood, 0.4)
    white = scene.material({"name": "white lacquer", "pbrMetallicRoughness": {
        "baseColorFactor": [0.8, 0.8, 0.77, 1], "metallicFactor": 0, "roughnessFactor": 0.25}})
    brass = scene.material({"name": "brass", "pbrMetallicRoughness": {
        "baseColorFactor": [0.91, 0.78, 0.42, 1], "metallicFactor": 1, "roughnessFactor": 0.3}})
    front, back = STAIR_Z + STAIR_WIDTH / 2, STAIR_Z - STAIR_WIDTH / 2
    for i in range(STEPS):
        x, y = START + i * RUN, (i + 1) * RISE
        scene.quads(f"riser {i}", white, cuboid((x, 0 if i == 0 else y - 2 * RISE, back), (x + RUN + 0.02, y - 0.03, front - 0.02)))
        scene.quads(f"tread {i}", oak, cuboid((x - NOSE, y - 0.03, back), (x + RUN + 0.02, y, front)), tile=0.9 + 0.01 * i)
        for part in (0.25, 0.75):
            bx = x + part * RUN
            positions, triangles, normals = rod((bx, y, front - 0.05), (bx, y + 0.9 + part * RISE, front - 0.05), 0.012)
            scene.mesh("baluster", brass, positions, triangles, normals)
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
    scene.mesh("vase", glaze, positions, triangles, normals, translation=[1.95, 0, -0.2])

    positions, triangles, normals = sphere(0.16, 32, 64)
    copper = scene.material({"name": "copper", "pbrMetallicRoughness": {
        "baseColorFactor": [0.95, 0.64, 0.54, 1], "metallicFactor": 1, "roughnessFactor": 0.15}})
    scene.mesh("ball", copper, positions, triangles, normals, translation=[1.2, 0.161, 0.75])

    globe, triangles, normals = sphere(0.2, 24, 48)
    scene.mesh("globe", scene.material(lamp("globe", 0.8, LUMINANCE, "cie:LED-B3")), globe, triangles, normals,
               translation=[-0.6, 2.75, 0.9])
    cord, triangles, normals = rod((-0.6, 2.95, 0.9), (-0.6, 3.4, 0.9), 0.008, 8)
    scene.mesh("cord", scene.material(lambert("cord", (0.05, 0.05, 0.05))), cord, triangles, normals)


def main():
    FOLDER.mkdir(exist_ok=True)
    scene = Scene("Photopic's authors")
    add_hall(scene)
    add_stairs(scene)
    add_things(scene)
    turn, tilt = math.radians(8) / 2, math.radians(-7) / 2
    rotation = [math.cos(turn) * math.sin(tilt), math.sin(turn) * math.cos(tilt), -math.sin(turn) * math.sin(tilt), math.cos(turn) * math.cos(tilt)]
    scene.camera(math.radians(48), [400, 300], translation=[0.75, 1.45, 3.9], rotation=rotation)
    scene.write_glb(FOLDER / "scene.glb")


if __name__ == "__main__":
    main()
