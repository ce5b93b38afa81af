#!/usr/bin/env python3
"""Writes prism/scene.glb: five slits of light, one above the other, seen directly and through a prism of SF11, which spreads each into
its lamp's spectrum. From above: incandescent (CIE A), white LED (CIE LED-B5), three-coloured LED (CIE LED-RGB1), fluorescent tube
(CIE FL11) and high-pressure sodium (CIE HP1). Of our own making.

The prism stands where a look at light of 550 nm is turned least. Places on the floor are (x, depth), depth away from the camera;
angles count counter-clockwise from +x, seen from above.
"""

import math
import pathlib

from gltf_writer import Scene, lambert, lamp, png, product, turned
from patterns import wood

FOLDER = pathlib.Path(__file__).parent / "prism"
INDEX = 1.7919  # of SF11 near 550 nm
SIDE, HIGH, GAP = 0.17, 0.33, 0.001  # of the prism [m]; its distance from the table
TO_PRISM, ONWARDS = 0.62, 0.60  # from the camera, from the prism to the slits [m]
LOOK = math.radians(73)  # from the camera to the prism
LAMPS = ["cie:A", "cie:LED-B5", "cie:LED-RGB1", "cie:FL11", "cie:HP1"]
SLIT, SLIT_HIGH, PITCH, LOWEST = 0.0025, 0.044, 0.050, 0.045  # width, height, distance between lower ends, the first's height [m]
LUMINANCE, CEILING = 9, 12  # of the slits and the panel above [cd/m2]


def ahead(place, angle, distance):
    return (place[0] + distance * math.cos(angle), place[1] + distance * math.sin(angle))


def upright(left, right, low, high):
    """A wall over two places, seen from where `left` stands left."""
    (a, b), (c, d) = left, right
    return [(a, low, -b), (c, low, -d), (c, high, -d), (a, high, -b)]


def board(middle, facing, width, low, high):
    """An upright rectangle that looks into the direction `facing`."""
    return upright(ahead(middle, facing - math.pi / 2, width / 2), ahead(middle, facing + math.pi / 2, width / 2), low, high)


def add_prism(scene, middle, onwards):
    """@param middle of the way that the look takes inside; onwards: where it leaves to"""
    glass = scene.material({"name": "SF11", "pbrMetallicRoughness": {"metallicFactor": 0, "roughnessFactor": 0},
                            "extensions": {"KHR_materials_transmission": {"transmissionFactor": 1},
                                           "KHR_materials_ior": {"ior": 1.7847},
                                           "KHR_materials_volume": {"thicknessFactor": SIDE}},
                            "extras": {"glass": "SF11"}})
    to_base = (LOOK + onwards) / 2 + math.pi / 2
    centre = ahead(middle, to_base, SIDE * math.sqrt(3) / 12)
    corners = [ahead(centre, to_base + math.pi + turn * 2 * math.pi / 3, SIDE / math.sqrt(3)) for turn in range(3)]
    top, bottom = ([(x, y, -depth) for x, depth in corners] for y in (HIGH, GAP))
    positions = [p for a, b in zip(corners, corners[1:] + corners[:1]) for p in upright(a, b, GAP, HIGH)] + top + bottom[::-1]
    triangles = [t for q in (0, 4, 8) for t in ((q, q + 1, q + 2), (q, q + 2, q + 3))] + [(12, 13, 14), (15, 16, 17)]
    scene.mesh("prism", glass, positions, triangles)


def main():
    FOLDER.mkdir(exist_ok=True)
    scene = Scene("Photopic's authors")
    onwards = LOOK + 2 * math.asin(INDEX / 2) - math.pi / 3
    prism, inside = (0.19, 0.02), (LOOK + onwards) / 2
    camera = ahead(ahead(prism, inside, -SIDE / 4), LOOK, -TO_PRISM)
    slits = ahead(ahead(prism, inside, SIDE / 4), onwards, ONWARDS)
    facing = onwards + math.pi - math.radians(20)

    image = png(512, 512, lambda x, y: wood((x + 0.5) / 512, (y + 0.5) / 512, light=(0.42, 0.31, 0.23), dark=(0.24, 0.16, 0.11)))
    table = scene.material({"name": "table", "pbrMetallicRoughness": {
        "baseColorTexture": scene.texture(image), "metallicFactor": 0, "roughnessFactor": 0.35}})
    scene.quads("table", table, [[(-1.5, 0, 1.2), (1.5, 0, 1.2), (1.5, 0, -1.2), (-1.5, 0, -1.2)]], tile=0.8)
    wall = scene.material(lambert("wall", (0.16, 0.19, 0.24)))
    scene.quads("wall", wall, [[(-2.5, -1, -1.4), (2.5, -1, -1.4), (2.5, 2, -1.4), (-2.5, 2, -1.4)]])
    add_prism(scene, prism, onwards)
    black = scene.material(lambert("black", (0.02, 0.02, 0.02), doubleSided=True))
    scene.quads("mask", black, [board(slits, facing, 0.3, 0, LOWEST + len(LAMPS) * PITCH + 0.03)])
    before = ahead(slits, facing, 0.002)
    for i, spectrum in enumerate(LAMPS):
        low = LOWEST + (len(LAMPS) - 1 - i) * PITCH
        scene.quads(spectrum, scene.material(lamp(spectrum, 0, LUMINANCE, spectrum)), [board(before, facing, SLIT, low, low + SLIT_HIGH)])
    panel = [(-1, 1.9, -0.6), (1, 1.9, -0.6), (1, 1.9, 1), (-1, 1.9, 1)]
    scene.quads("ceiling", scene.material(lamp("ceiling", 0.5, CEILING, "cie:D50")), [panel])

    scene.camera(math.radians(26.5), [640, 360], translation=[camera[0], 0.29, -camera[1]],
                 rotation=product(turned((0, 1, 0), -0.2), turned((1, 0, 0), -8.5)))
    scene.write_glb(FOLDER / "scene.glb")


if __name__ == "__main__":
    main()
