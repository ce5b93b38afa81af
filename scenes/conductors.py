#!/usr/bin/env python3
"""Writes conductors/scene.glb: balls of five metals by their measured index, polished in front and rough behind, under a panel with
the spectrum of a fluorescent tube (CIE FL11). Of our own making."""

import math
import pathlib

from gltf_writer import Scene, lambert, lamp
from shapes import sphere

FOLDER = pathlib.Path(__file__).parent / "conductors"
METALS = ["Ag", "Al", "Au", "Cu", "Cr"]
ROWS = [(0.03, 0.5, 0.42), (0.35, -0.75, 0.42)]  # roughness, place along z, radius
LUMINANCE = 9  # of the panel [cd/m2]


def main():
    FOLDER.mkdir(exist_ok=True)
    scene = Scene("Photopic's authors")
    wide, high, back, front = 4.0, 3.2, -2.2, 5.0
    scene.quads("floor", scene.material(lambert("slate", (0.18, 0.19, 0.21))),
                [[(-wide, 0, front), (wide, 0, front), (wide, 0, back), (-wide, 0, back)]])
    plaster = scene.material(lambert("plaster", (0.7, 0.68, 0.65)))
    scene.quads("walls", plaster, [
        [(-wide, 0, back), (wide, 0, back), (wide, high, back), (-wide, high, back)],
        [(wide, 0, front), (-wide, 0, front), (-wide, high, front), (wide, high, front)],
        [(-wide, high, back), (wide, high, back), (wide, high, front), (-wide, high, front)],
        [(-wide, 0, front), (-wide, 0, back), (-wide, high, back), (-wide, high, front)],
        [(wide, 0, back), (wide, 0, front), (wide, high, front), (wide, high, back)]])
    panel = [(-1.6, high - 0.01, -0.6), (1.6, high - 0.01, -0.6), (1.6, high - 0.01, 1.4), (-1.6, high - 0.01, 1.4)]
    scene.quads("panel", scene.material(lamp("panel", 0.8, LUMINANCE, "cie:FL11")), [panel])
    for roughness, z, radius in ROWS:
        positions, triangles, normals = sphere(radius, rings=32, sectors=64)
        for i, metal in enumerate(METALS):
            material = {"name": f"{metal} {roughness}", "extras": {"conductor": metal},
                        "pbrMetallicRoughness": {"metallicFactor": 1, "roughnessFactor": roughness}}
            scene.mesh(material["name"], scene.material(material), positions, triangles, normals,
                       translation=[1.05 * (i - 2), radius * 1.004, z])
    pitch = math.radians(-14)
    scene.camera(math.radians(36), [400, 240], translation=[0, 1.6, 4.7], rotation=[math.sin(pitch / 2), 0, 0, math.cos(pitch / 2)])
    scene.write_glb(FOLDER / "scene.glb")


if __name__ == "__main__":
    main()
