#!/usr/bin/env python3
"""Writes many-lights/: a hall under 1,000 small lamps of three kinds.

Four storeys of shelves in a closed hall of 12 m by 12 m by 4 m; a lamp of 4 cm by 4 cm hangs under each place of a grid of 25 by
40, of the fluorescent, incandescent and daylight-LED kind (CIE FL11, a blackbody at 2700 K, CIE LED-B5) in turn, some looking
aside. All lamps have the luminance of 800 cd/m2.
"""

import math
import pathlib
import random

from gltf_writer import Scene, lambert, lamp

FOLDER = pathlib.Path(__file__).parent / "many-lights"
SIZE, HEIGHT = 6.0, 4.0  # half the sides and the height of the hall [m]
COLUMNS, ROWS, HALF = 25, 40, 0.02  # of lamps, and half a lamp's side [m]
LUMINANCE = 100  # [cd/m2]; exposes the picture well at 0 EV
LAMPS = {"tube": "cie:FL11", "bulb": "blackbody:2700", "led": "cie:LED-B5"}


def box(low, high, inwards=False):
    """Six quads, seen counter-clockwise from outside (or from inside)."""
    (x0, y0, z0), (x1, y1, z1) = low, high
    faces = [[(x0, y0, z1), (x1, y0, z1), (x1, y1, z1), (x0, y1, z1)], [(x1, y0, z0), (x0, y0, z0), (x0, y1, z0), (x1, y1, z0)],
             [(x1, y0, z1), (x1, y0, z0), (x1, y1, z0), (x1, y1, z1)], [(x0, y0, z0), (x0, y0, z1), (x0, y1, z1), (x0, y1, z0)],
             [(x0, y1, z1), (x1, y1, z1), (x1, y1, z0), (x0, y1, z0)], [(x0, y0, z0), (x1, y0, z0), (x1, y0, z1), (x0, y0, z1)]]
    return [face[::-1] for face in faces] if inwards else faces


def hanging_quad(middle, tilt, turn):
    """A square that looks down, tilted about a horizontal axis."""
    x, y, z = middle
    along = (math.cos(turn), 0, math.sin(turn))
    across = (-math.sin(turn) * math.cos(tilt), math.sin(tilt), math.cos(turn) * math.cos(tilt))
    corner = lambda a, b: tuple(m + HALF * (a * s + b * t) for m, s, t in zip((x, y, z), along, across))
    return [corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1)]


def main():
    FOLDER.mkdir(exist_ok=True)
    scene = Scene("Made for this project")
    white = scene.material(lambert("white", (0.7, 0.7, 0.7)))
    wood = scene.material(lambert("wood", (0.45, 0.28, 0.15)))
    scene.quads("hall", white, box((-SIZE, 0, -SIZE), (SIZE, HEIGHT, SIZE), inwards=True))
    shelves = [face for x in range(-5, 6, 2) for y in range(4)
               for face in box((x, 0.8 * y + 0.1, -4.5), (x + 0.5, 0.8 * y + 0.15, 4.5))]
    scene.quads("shelves", wood, shelves)

    numbers = random.Random(1)
    quads = {name: [] for name in LAMPS}
    for i in range(COLUMNS * ROWS):
        x = SIZE * (2 * (i % COLUMNS + 0.5) / COLUMNS - 1)
        z = SIZE * (2 * (i // COLUMNS + 0.5) / ROWS - 1)
        tilt = numbers.uniform(0, 1.2) if i % 4 == 0 else 0.0
        quads[list(LAMPS)[i % 3]].append(hanging_quad((x, HEIGHT - 0.1 - 0.4 * numbers.random(), z), tilt, numbers.uniform(0, 6.28)))
    for name, spectrum in LAMPS.items():
        scene.quads(name, scene.material(lamp(name, 0.5, LUMINANCE, spectrum)), quads[name])

    scene.camera(0.9, [320, 180], translation=(0.2, 1.7, 5.7), rotation=[-0.05, 0.0, 0.0, 0.99875])
    scene.write_glb(FOLDER / "scene.glb")


if __name__ == "__main__":
    main()
