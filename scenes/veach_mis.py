#!/usr/bin/env python3
"""Writes veach-mis/scene.glb: four plates of rising roughness under four spherical lamps of falling size and equal power.

After the scene that E. Veach shows in "Robust Monte Carlo Methods for Light Transport Simulation" (1997), section 9.2; the
measures here are our own. Each plate is tilted so that its middle mirrors the lamps to the camera. The lamps, large to small,
are CIE FL1, FL2, FL11 and FL12.
"""

import math
import pathlib

from gltf_writer import Scene, lambert, lamp, turned
from shapes import sphere

FOLDER = pathlib.Path(__file__).parent / "veach-mis"
EYE, LAMPS_AT = (0, 3.0, 14), (0, 3.5, -2.5)  # the camera, the middle of the row of lamps
PLATES = [(0.05, -1.3, 4.0), (0.12, -1.0, 2.2), (0.25, -0.4, 0.5), (0.45, 0.5, -0.9)]  # roughness, height, place along z
PLATE_WIDTH, PLATE_DEPTH = 7.4, 1.25
LAMPS = [("cie:FL1", 0.9, -3.6), ("cie:FL2", 0.3, -1.2), ("cie:FL11", 0.1, 0.9), ("cie:FL12", 0.033, 2.7)]  # radius, x
POWER = 3  # luminance times squared radius, of each lamp [cd]


def unit(v):
    length = math.hypot(*v)
    return tuple(x / length for x in v)


def plate_normal(middle):
    """Half way between the camera and the lamps."""
    to_eye, to_lamps = (unit(tuple(p[i] - middle[i] for i in range(3))) for p in (EYE, LAMPS_AT))
    return unit(tuple(a + b for a, b in zip(to_eye, to_lamps)))


def plate(middle):
    _, up, out = plate_normal(middle)
    side, rise = PLATE_WIDTH / 2, PLATE_DEPTH / 2
    along = (0, -out * rise, up * rise)  # in the plate, towards the camera
    near, far = (tuple(m + s * a for m, a in zip(middle, along)) for s in (1, -1))
    corner = lambda edge, x: (edge[0] + x, edge[1], edge[2])
    return [corner(near, -side), corner(near, side), corner(far, side), corner(far, -side)]


def main():
    FOLDER.mkdir(exist_ok=True)
    scene = Scene("Photopic's authors")
    grey = scene.material(lambert("grey", (0.4, 0.4, 0.4)))
    floor, back, wide, high, front = -1.8, -9.0, 24, 20, 18
    scene.quads("floor", grey, [[(-wide, floor, front), (wide, floor, front), (wide, floor, back), (-wide, floor, back)]])
    scene.quads("wall", grey, [[(-wide, floor, back), (wide, floor, back), (wide, high, back), (-wide, high, back)]])

    for i, (roughness, y, z) in enumerate(PLATES):
        steel = {"name": f"plate {i}", "doubleSided": True, "pbrMetallicRoughness": {
            "baseColorFactor": [0.55, 0.57, 0.6, 1], "metallicFactor": 1, "roughnessFactor": roughness}}
        scene.quads(f"plate {i}", scene.material(steel), [plate((0, y, z))])

    for spectrum, radius, x in LAMPS:
        positions, triangles, normals = sphere(radius, rings=24, sectors=48)
        material = scene.material(lamp(f"lamp {spectrum}", 0, POWER / radius ** 2, spectrum))
        scene.mesh(f"lamp {spectrum}", material, positions, triangles, normals, translation=[x, *LAMPS_AT[1:]])

    scene.camera(math.radians(32), [480, 270], translation=list(EYE), rotation=turned((1, 0, 0), -10.5))
    scene.write_glb(FOLDER / "scene.glb")


if __name__ == "__main__":
    main()
