#!/usr/bin/env python3
"""Writes two-lamps/: the room of the Cornell box under two lamps of different spectra.

Geometry of the room and the blocks, camera and wall reflectances as in cornell_box.py, which see for their source. Under the
ceiling hang a narrow-band fluorescent tube (CIE FL11) on the left and an incandescent lamp (blackbody at 2700 K) on the
right, of the same size and luminance.
"""

import math
import pathlib

from cornell_box import (BLOCK_TOPS, CAMERA, COLORS, FILM, FOCAL_LENGTH, LAMP_GAP, LAMP_REFLECTANCE, LIGHT, REFLECTANCES, WALLS,
                         block_faces, check_faces, metres)
from gltf_writer import Scene, lambert, lamp

FOLDER = pathlib.Path(__file__).parent / "two-lamps"
LUMINANCE = 20  # of each lamp [cd/m2]
LAMPS = {"tube": ("cie:FL11", 120), "bulb": ("blackbody:2700", -120)}  # spectrum, shift along x [mm]


def main():
    FOLDER.mkdir(exist_ok=True)
    scene = Scene("Geometry and reflectances: Cornell University Program of Computer Graphics")
    materials = {}
    for name, color in COLORS.items():
        assert name in REFLECTANCES
        spectrum = f"../cornell-box/{name}.csv"
        materials[name] = scene.material(lambert(name, color, extras={"reflectance_spectrum": spectrum}))

    for name, (paint, quad) in WALLS.items():
        scene.quads(name, materials[paint], [metres(quad)])
    for name, top in BLOCK_TOPS.items():
        scene.quads(name, materials["white"], [metres(face) for face in block_faces(top)])

    for name, (spectrum, shift) in LAMPS.items():
        quad = [(x + shift, y - LAMP_GAP, z) for x, y, z in LIGHT]
        check_faces(name, [quad], (278, 273, 280), inwards=True)
        scene.quads(name, scene.material(lamp(name, LAMP_REFLECTANCE, LUMINANCE, spectrum)), [metres(quad)])

    scene.camera(2 * math.atan(FILM / 2 / FOCAL_LENGTH), [256, 256], translation=metres([CAMERA])[0], rotation=[0, 1, 0, 0])
    scene.write_gltf(FOLDER / "scene.gltf")


if __name__ == "__main__":
    main()
