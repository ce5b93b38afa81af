#!/usr/bin/env python3
"""Writes glass-of-water/scene.glb: a tumbler of water with ice, air bubbles and a straw, beside a soft lamp with the spectrum of a
fluorescent tube (CIE FL10). Of our own making.

The water reaches into the glass and the ice into the water, as one models them; `extras` give the priorities by which the glass is
where they overlap, the air of bubbles before the ice, the ice before the water."""

import math
import pathlib

from gltf_writer import Scene, lambert, lamp
from patterns import hashed
from shapes import rod, rounded_profile, solid_of_revolution, sphere, with_smooth_normals

FOLDER = pathlib.Path(__file__).parent / "glass-of-water"
LUMINANCE = 9  # of the lamp [cd/m2]
FOOT, BRIM, HEIGHT, WALL, BASE = 0.030, 0.036, 0.105, 0.0024, 0.010  # of the tumbler, outer radii [m]
LEVEL = 0.078  # of the water


def glass(name, ior, priority, color, distance, roughness=0):
    """Clear and solid; light keeps `color` over `distance` [m]."""
    return {
        "name": name,
        "pbrMetallicRoughness": {"metallicFactor": 0, "roughnessFactor": roughness},
        "extensions": {
            "KHR_materials_transmission": {"transmissionFactor": 1},
            "KHR_materials_ior": {"ior": ior},
            "KHR_materials_volume": {"thicknessFactor": 0.01, "attenuationColor": color, "attenuationDistance": distance},
        },
        "extras": {"priority": priority},
    }


def inner_radius(y):
    return FOOT + (BRIM - FOOT) * y / HEIGHT - WALL


def add_tumbler(scene):
    profile = rounded_profile([(0, 0.0012, 0), (0.018, 0.0012, 0.02), (0.021, 0, 0.002), (FOOT, 0, 0.004), (BRIM, HEIGHT, 0.0011),
                               (BRIM - WALL, HEIGHT, 0.0011), (inner_radius(BASE), BASE, 0.006), (0, BASE + 0.001, 0)])
    scene.mesh("tumbler", scene.material(glass("glass", 1.52, 30, (0.86, 0.97, 0.92), 0.08)), *solid_of_revolution(profile),
               translation=[0, 0.0002, 0])


def add_water(scene):
    """Up to the middle of the wall; at the wall it rises."""
    into = 0.5 * WALL
    profile = [(0, BASE - into), (0.5 * inner_radius(BASE), BASE - into)]
    profile += [(inner_radius(y) + into, y) for y in (BASE - into, 0.03, 0.05, 0.07)]
    edge = inner_radius(LEVEL)
    rise = lambda r: LEVEL + 0.0016 * math.exp(-max(edge - r, 0) / 0.0022)
    profile += [(r, rise(r)) for r in [edge + into] + [edge - 0.004 * (k / 16) ** 1.5 for k in range(17)]]
    profile += [(r, rise(r)) for r in (0.024, 0.016, 0.008)] + [(0, LEVEL)]
    scene.mesh("water", scene.material(glass("water", 1.333, 10, (0.80, 0.94, 0.98), 1.0)), *solid_of_revolution(profile),
               translation=[0, 0.0002, 0])


def turned(p, axis, angle):
    """Rodrigues' formula."""
    c, s = math.cos(angle), math.sin(angle)
    along = sum(a * x for a, x in zip(axis, p)) * (1 - c)
    across = (axis[1] * p[2] - axis[2] * p[1], axis[2] * p[0] - axis[0] * p[2], axis[0] * p[1] - axis[1] * p[0])
    return tuple(x * c + w * s + a * along for x, w, a in zip(p, across, axis))


def ice_cube(half, seed):
    """A cube with round edges that has begun to melt."""
    positions, triangles, _ = sphere(1, 40, 80)
    phase = [2 * math.pi * hashed(seed, k) for k in range(6)]
    cube = []
    for x, y, z in positions:
        reach = (abs(x) ** 7 + abs(y) ** 7 + abs(z) ** 7) ** (-1 / 7)
        p = [c * reach for c in (x, y, z)]
        lumps = 0.02 * (math.sin(2.7 * p[0] + phase[0]) * math.sin(2.3 * p[1] + phase[1])
                        + math.sin(3.1 * p[1] + phase[2]) * math.sin(2.9 * p[2] + phase[3])
                        + math.sin(3.3 * p[2] + phase[4]) * math.sin(2.1 * p[0] + phase[5]))
        cube.append(tuple(half * c * (1 + lumps) for c in p))
    return with_smooth_normals(cube, triangles)


ICE = [  # middle, half its side, axis and angle it is turned by [m, degrees]
    ((-0.0125, 0.0800, 0.0060), 0.0122, (0.36, 0.48, 0.80), 48),
    ((0.0105, 0.0770, 0.0105), 0.0112, (-0.48, 0.60, 0.64), 74),
    ((0.0075, 0.0795, -0.0150), 0.0118, (0.60, -0.64, 0.48), 33),
]


def add_ice(scene):
    material = scene.material(glass("ice", 1.31, 20, (0.90, 0.96, 0.98), 0.5, roughness=0.15))
    for seed, (middle, half, axis, angle) in enumerate(ICE):
        positions, triangles, normals = ice_cube(half, seed)
        turn = lambda list: [turned(p, axis, math.radians(angle)) for p in list]
        scene.mesh("ice cube", material, turn(positions), triangles, turn(normals), translation=list(middle))


def bubbles():
    """Middles and radii: a few trains that rise from the bottom, some at the wall, some frozen into the ice."""
    for train in range(5):
        angle, reach = 2 * math.pi * hashed(train, 1), 0.022 * math.sqrt(hashed(train, 2))
        for k in range(9):
            y = BASE + 0.004 + (LEVEL - BASE - 0.026) * (k + hashed(train, k, 3)) / 9
            sway = 0.0018 * math.sin(5 * k + train)
            yield (reach * math.cos(angle) + sway, y, reach * math.sin(angle) - sway), 0.0004 + 0.00012 * k
    for k in range(26):
        angle, y = 2 * math.pi * hashed(k, 4), BASE + 0.004 + (LEVEL - BASE - 0.008) * hashed(k, 5)
        radius = 0.0003 + 0.0007 * hashed(k, 6) ** 2
        reach = inner_radius(y) - 0.8 * radius  # flattened by the wall
        yield (reach * math.cos(angle), y, reach * math.sin(angle)), radius
    for seed, (middle, half, _, _) in enumerate(ICE):
        for k in range(7):
            offset = [half * (hashed(seed, k, axis, 7) - 0.5) for axis in range(3)]
            yield tuple(m + o for m, o in zip(middle, offset)), 0.0003 + 0.0006 * hashed(seed, k, 8)


def add_bubbles(scene):
    ball, faces, directions = sphere(1, 12, 24)
    positions, triangles, normals = [], [], []
    for middle, radius in bubbles():
        triangles += [tuple(k + len(positions) for k in face) for face in faces]
        positions += [tuple(m + radius * x for m, x in zip(middle, p)) for p in ball]
        normals += directions
    scene.mesh("bubbles", scene.material(glass("air", 1.0, 25, (1, 1, 1), 1.0)), positions, triangles, normals)


def add_straw(scene):
    plastic = scene.material({"name": "straw", "doubleSided": True, "pbrMetallicRoughness": {
        "baseColorFactor": [0.72, 0.06, 0.05, 1], "metallicFactor": 0, "roughnessFactor": 0.3}})
    scene.mesh("straw", plastic, *rod((-0.0185, 0.0145, -0.002), (0.047, 0.150, -0.006), 0.0028, 32))


def add_surroundings(scene):
    wide, back, front, high = 0.7, -0.45, 0.9, 1.0
    table = scene.material({"name": "slate", "pbrMetallicRoughness": {
        "baseColorFactor": [0.16, 0.17, 0.19, 1], "metallicFactor": 0, "roughnessFactor": 0.45}})
    scene.quads("table", table, [[(-wide, 0, front), (wide, 0, front), (wide, 0, back), (-wide, 0, back)]])
    scene.quads("back", scene.material(lambert("blue wall", (0.16, 0.27, 0.36))),
                [[(-wide, 0, back), (wide, 0, back), (wide, high, back), (-wide, high, back)]])
    wall = scene.material(lambert("wall", (0.45, 0.45, 0.43)))
    scene.quads("walls", wall, [
        [(wide, 0, front), (-wide, 0, front), (-wide, high, front), (wide, high, front)],
        [(-wide, 0, front), (-wide, 0, back), (-wide, high, back), (-wide, high, front)],
        [(wide, 0, back), (wide, 0, front), (wide, high, front), (wide, high, back)],
        [(-wide, high, back), (wide, high, back), (wide, high, front), (-wide, high, front)]])
    x, low, top = -0.5, 0.05, 0.8  # upright, to the left
    scene.quads("lamp", scene.material(lamp("lamp", 0.8, LUMINANCE, "cie:FL10")),
                [[(x, low, 0.4), (x - 0.06, low, -0.4), (x - 0.06, top, -0.4), (x, top, 0.4)]])


def main():
    FOLDER.mkdir(exist_ok=True)
    scene = Scene("Photopic's authors")
    add_surroundings(scene)
    add_tumbler(scene)
    add_water(scene)
    add_ice(scene)
    add_bubbles(scene)
    add_straw(scene)
    pitch = math.radians(-12)
    scene.camera(math.radians(23), [360, 450], translation=[0.0, 0.137, 0.40], rotation=[math.sin(pitch / 2), 0, 0, math.cos(pitch / 2)])
    scene.write_glb(FOLDER / "scene.glb")


if __name__ == "__main__":
    main()
