#!/usr/bin/env python3
"""Writes diamond/scene.glb: three round brilliants on dark cloth under panels, rings of small lamps and a dim tent, open to the front,
all with the spectrum of a white LED (CIE LED-B5). Of our own making.

The main proportions are M. Tolkowsky's ("Diamond Design", 1919): table 53 % of the girdle's diameter, crown at 34.5 degrees, pavilion
at 40.75 degrees. The minor facets are ours: stars reach half way to the girdle, lower halves 77 % of the way to the culet, and the
girdle is 2 % of the diameter thick.
"""

import math
import pathlib

from gltf_writer import Scene, cross, lambert, lamp, product, subtract, turned
from shapes import cuboid, polygons

FOLDER = pathlib.Path(__file__).parent / "diamond"
TABLE, CROWN, PAVILION = 0.53, math.radians(34.5), math.radians(40.75)  # the table as a share of the diameter
STAR, LOWER, GIRDLE = 0.5, 0.77, 0.04  # lengths as shares of the way; the girdle's thickness as a share of its radius
PANEL, SPOTS, GLOW = 2.2, 60.0, 0.13  # luminances of panels, spots and tent [cd/m2]
TENT, SPOT = 18.0, 0.26  # half their sides
LIFT = 0.001  # of the stones above the cloth


def at(radius, eighths, height):
    angle = eighths * math.pi / 4
    return (radius * math.cos(angle), height, -radius * math.sin(angle))


def brilliant():
    """The 57 facets and the 16 faces of the girdle, of radius 1 about the y axis, its upper edge at 0; counter-clockwise
    seen from outside."""
    half = math.cos(math.pi / 8)  # a main facet's plane falls by 1 − r cos(azimuth) times its slope
    table = lambda k: at(TABLE, k, (1 - TABLE) * math.tan(CROWN))
    star_radius = 1 - (1 - STAR) * (1 - TABLE * half)
    star = lambda k: at(star_radius, k + 0.5, (1 - star_radius * half) * math.tan(CROWN))
    lower = lambda k: at(1 - LOWER, k + 0.5, -GIRDLE - (1 - (1 - LOWER) * half) * math.tan(PAVILION))
    rim = lambda k: at(1, k, 0)
    hem = lambda k: at(1, k, -GIRDLE)
    culet = (0, -GIRDLE - math.tan(PAVILION), 0)

    faces = [[table(k) for k in range(8)]]
    for k in range(8):
        faces += [[table(k), star(k), table(k + 1)],  # star
                  [table(k), star(k - 1), rim(k), star(k)],  # bezel
                  [star(k), rim(k), rim(k + 0.5)], [star(k), rim(k + 0.5), rim(k + 1)],  # upper halves
                  [lower(k), hem(k + 0.5), hem(k)], [lower(k), hem(k + 1), hem(k + 0.5)],  # lower halves
                  [culet, lower(k), hem(k), lower(k - 1)]]  # pavilion main
        faces += [[rim(j), hem(j), hem(j + 0.5), rim(j + 0.5)] for j in (k, k + 0.5)]
    return faces


def facing(middle, target, across, high):
    """A rectangle of these half sides that looks from `middle` at `target`."""
    out = subtract(target, middle)
    out = tuple(x / math.hypot(*out) for x in out)
    side = cross((0, 1, 0), out)
    side = tuple(x / math.hypot(*side) for x in side)
    up = cross(out, side)
    return [tuple(m + a * across * s + b * high * t for m, s, t in zip(middle, side, up)) for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1))]


def add_lamps(scene):
    panels = [facing(*panel) for panel in (((-5.5, 4.0, 1.5), (0, 0.6, 0), 1.6, 1.6), ((4.5, 5.5, -4.0), (0, 0.6, 0), 2.0, 1.2),
                                           ((0.5, 7.5, 4.5), (0, 0.6, 0), 2.2, 0.8))]
    scene.quads("panels", scene.material(lamp("panels", 0.5, PANEL, "cie:LED-B5")), panels)
    _, back, right, left, top, _ = (face[::-1] for face in cuboid((-TENT, -1, -TENT), (TENT, 12, TENT)))
    scene.quads("tent", scene.material(lamp("tent", 0, GLOW, "cie:LED-B5")), [back, left, right])
    spots = []
    for ring, (height, radius, count) in enumerate(((7.5, 2.0, 7), (5.5, 5.5, 11), (2.5, 7.0, 13))):
        for i in range(count):
            phi = 2 * math.pi * (i + 0.37 * ring) / count
            spots.append(facing((radius * math.cos(phi), height, radius * math.sin(phi)), (0, 0.6, 0), SPOT, SPOT))
    scene.quads("spots", scene.material(lamp("spots", 0, SPOTS, "cie:LED-B5")), spots)


def lying(degrees):
    """On a main facet of the pavilion, the table turned to this azimuth, counter-clockwise from +x."""
    return product(turned((0, 1, 0), degrees), turned((0, 0, 1), -math.degrees(PAVILION)))


def on_culet(x, z, scale, rotation):
    culet = (0, scale * (GIRDLE + math.tan(PAVILION)), 0)
    a, b, c, w = rotation
    u = (a, b, c)
    t = tuple(2 * x for x in cross(u, culet))
    place = tuple(p + w * q + r for p, q, r in zip(culet, t, cross(u, t)))
    return {"translation": [x + place[0], LIFT + place[1], z + place[2]], "rotation": rotation, "scale": [scale] * 3}


def on_table(x, z, scale, degrees):
    height = scale * (1 - TABLE) * math.tan(CROWN)
    return {"translation": [x, LIFT + height, z], "rotation": product(turned((0, 1, 0), degrees), turned((1, 0, 0), 180)), "scale": [scale] * 3}


def main():
    FOLDER.mkdir(exist_ok=True)
    scene = Scene("Photopic's authors")
    cloth = scene.material(lambert("cloth", (0.03, 0.04, 0.075)))
    scene.quads("cloth", cloth, [[(-TENT, 0, TENT), (TENT, 0, TENT), (TENT, 0, -TENT), (-TENT, 0, -TENT)]])
    add_lamps(scene)

    diamond = scene.material({"name": "diamond", "pbrMetallicRoughness": {"metallicFactor": 0, "roughnessFactor": 0},
                              "extensions": {"KHR_materials_transmission": {"transmissionFactor": 1},
                                             "KHR_materials_ior": {"ior": 2.417},
                                             "KHR_materials_volume": {"thicknessFactor": 1}},
                              "extras": {"glass": "diamond"}})
    positions, triangles = polygons(brilliant())
    stones = [on_culet(-0.1, 0, 1, lying(-70)), on_culet(-1.75, -2.2, 0.8, lying(-120)), on_table(1.7, -1.1, 0.75, 15)]
    for stone in stones:
        scene.mesh("stone", diamond, positions, triangles, **stone)
    scene.camera(math.radians(23.5), [480, 320], translation=[-0.05, 3.9, 6.7], rotation=turned((1, 0, 0), -26))
    scene.write_glb(FOLDER / "scene.glb")


if __name__ == "__main__":
    main()
