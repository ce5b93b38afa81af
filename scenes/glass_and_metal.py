#!/usr/bin/env python3
"""Writes glass-and-metal/scene.glb: glass and metal on a table in a small room, under a fluorescent panel. Of our own making."""

import math
import pathlib

from gltf_writer import Scene, lambert, lamp, png, turned
from patterns import wood
from shapes import box, sphere, torus

FOLDER = pathlib.Path(__file__).parent / "glass-and-metal"
LUMINANCE = 4.5  # of the panel [cd/m2]; exposes the picture well at 0 EV


def glass(name, roughness, thickness, color, distance):
    return {
        "name": name,
        "pbrMetallicRoughness": {"metallicFactor": 0, "roughnessFactor": roughness},
        "extensions": {
            "KHR_materials_transmission": {"transmissionFactor": 1},
            "KHR_materials_ior": {"ior": 1.5},
            "KHR_materials_volume": {"thicknessFactor": thickness, "attenuationColor": color, "attenuationDistance": distance},
        },
    }


def metal(name, color, roughness):
    return {"name": name, "pbrMetallicRoughness": {"baseColorFactor": [*color, 1], "metallicFactor": 1, "roughnessFactor": roughness}}


def add_room(scene):
    """Walls 4 m wide, 2.6 m high; the table top is the floor. The camera looks in through the open front."""
    wide, high, back, front = 2.0, 2.6, -1.6, 4.0
    floor = [(-wide, 0, front), (wide, 0, front), (wide, 0, back), (-wide, 0, back)]
    ceiling = [(-wide, high, back), (wide, high, back), (wide, high, front), (-wide, high, front)]
    back_wall = [(-wide, 0, back), (wide, 0, back), (wide, high, back), (-wide, high, back)]
    front_wall = [(wide, 0, front), (-wide, 0, front), (-wide, high, front), (wide, high, front)]
    left = [(-wide, 0, front), (-wide, 0, back), (-wide, high, back), (-wide, high, front)]
    right = [(wide, 0, back), (wide, 0, front), (wide, high, front), (wide, high, back)]
    image = png(512, 512, lambda x, y: wood((x + 0.5) / 512, (y + 0.5) / 512, light=(0.66, 0.52, 0.40), dark=(0.42, 0.30, 0.22)))
    table = scene.material({"name": "table", "pbrMetallicRoughness": {
        "baseColorTexture": scene.texture(image), "metallicFactor": 0, "roughnessFactor": 0.5}})
    scene.quads("table", table, [floor], tile=1.3)
    scene.quads("walls", scene.material(lambert("plaster", (0.75, 0.74, 0.70))), [ceiling, back_wall, front_wall])
    scene.quads("left", scene.material(lambert("terracotta", (0.62, 0.22, 0.12))), [left])
    scene.quads("right", scene.material(lambert("blue", (0.12, 0.24, 0.50))), [right])
    panel = [(-1.1, high - 0.01, -0.7), (1.1, high - 0.01, -0.7), (1.1, high - 0.01, 1.1), (-1.1, high - 0.01, 1.1)]
    scene.quads("panel", scene.material(lamp("panel", 0.8, LUMINANCE, "cie:FL11")), [panel])


def add_objects(scene):
    positions, triangles, normals = sphere(0.36)
    lift = 0.3605  # a hair above the table
    clear = scene.material(glass("clear glass", 0, 0.7, (0.55, 0.92, 0.78), 0.6))
    scene.mesh("glass ball", clear, positions, triangles, normals, translation=[-0.15, lift * 1.003, 0.35])
    silver = scene.material(metal("silver", (0.95, 0.93, 0.90), 0.02))
    scene.mesh("silver ball", silver, positions, triangles, normals, translation=[0.75, lift * 1.28, -0.45], scale=[1.27] * 3)

    positions, triangles, normals = torus(0.36, 0.13)
    gold = scene.material({"name": "gold", "extras": {"conductor": "Au"},
                           "pbrMetallicRoughness": {"metallicFactor": 1, "roughnessFactor": 0.3}})
    scene.mesh("gold ring", gold, positions, triangles, normals, translation=[-0.85, 0.4485, -0.55],
               rotation=turned((1, 0, 0), 62))

    frosted = scene.material(glass("frosted glass", 0.3, 0.4, (0.95, 0.75, 0.55), 0.5))
    scene.quads("frosted block", frosted, box(0.2, 0.2, 0.2), translation=[0.62, 0.201, 0.55],
                rotation=turned((0, 1, 0), 28))


def main():
    FOLDER.mkdir(exist_ok=True)
    scene = Scene("Photopic's authors")
    add_room(scene)
    add_objects(scene)
    scene.camera(math.radians(31), [400, 300], translation=[0, 1.15, 3.35], rotation=turned((1, 0, 0), -15.5))
    scene.write_glb(FOLDER / "scene.glb")


if __name__ == "__main__":
    main()
