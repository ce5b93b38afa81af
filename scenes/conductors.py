#!/usr/bin/env python3
"""Writes conductors/scene.glb: balls of five metals (silver, aluminium, gold, copper, chromium) by their measured index, polished in
front and rough on a step behind, under a panel with the spectrum of a fluorescent tube (CIE FL11). Of our own making."""

import math
import pathlib

from gltf_writer import Scene, lambert, lamp, turned
from shapes import cuboid, sphere

FOLDER = pathlib.Path(__file__).parent / "conductors"
METALS = ["Ag", "Al", "Au", "Cu", "Cr"]
RADIUS = 0.42
ROWS = [(0.03, 0.55, 0.0), (0.35, -0.6, 0.5)]  # roughness, place along z, height of what the balls stand on
LUMINANCE = 5.5  # of the panel [cd/m2]; exposes the picture well at 0 EV


def main():
    FOLDER.mkdir(exist_ok=True)
    scene = Scene("Photopic's authors")
    wide, high, back, front = 4.0, 3.4, -2.4, 5.5
    slate = scene.material({"name": "slate", "pbrMetallicRoughness": {
        "baseColorFactor": [0.10, 0.11, 0.13, 1], "metallicFactor": 0, "roughnessFactor": 0.35}})
    scene.quads("floor", slate, [[(-wide, 0, front), (wide, 0, front), (wide, 0, back), (-wide, 0, back)]])
    scene.quads("step", slate, cuboid((-3.2, 0.001, -1.2), (3.2, ROWS[1][2], back + 0.01)))
    plaster = scene.material(lambert("plaster", (0.62, 0.63, 0.66)))
    scene.quads("walls", plaster, [
        [(wide, 0, front), (-wide, 0, front), (-wide, high, front), (wide, high, front)],
        [(-wide, high, back), (wide, high, back), (wide, high, front), (-wide, high, front)],
        [(-wide, 0, front), (-wide, 0, back), (-wide, high, back), (-wide, high, front)],
        [(wide, 0, back), (wide, 0, front), (wide, high, front), (wide, high, back)]])
    scene.quads("back wall", scene.material(lambert("blue", (0.10, 0.15, 0.24))),
                [[(-wide, 0, back), (wide, 0, back), (wide, high, back), (-wide, high, back)]])
    panel = [(-2.2, high - 0.01, -0.9), (2.2, high - 0.01, -0.9), (2.2, high - 0.01, 1.5), (-2.2, high - 0.01, 1.5)]
    scene.quads("panel", scene.material(lamp("panel", 0.8, LUMINANCE, "cie:FL11")), [panel])
    for roughness, z, height in ROWS:
        positions, triangles, normals = sphere(RADIUS, rings=32, sectors=64)
        for i, metal in enumerate(METALS):
            material = {"name": f"{metal} {roughness}", "extras": {"conductor": metal},
                        "pbrMetallicRoughness": {"metallicFactor": 1, "roughnessFactor": roughness}}
            scene.mesh(material["name"], scene.material(material), positions, triangles, normals,
                       translation=[0.98 * (i - 2), height + RADIUS * 1.004, z])
    scene.camera(math.radians(33), [480, 270], translation=[0, 2.05, 5.35], rotation=turned((1, 0, 0), -15))
    scene.write_glb(FOLDER / "scene.glb")


if __name__ == "__main__":
    main()
