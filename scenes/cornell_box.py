#!/usr/bin/env python3
"""Writes cornell-box/: the Cornell box from its published measurements.

Source: Cornell University Program of Computer Graphics, "Cornell Box Data" (https://www.graphics.cornell.edu/online/box/data.html):
coordinates in millimetres, camera, and wall reflectances. Differences from it:
- the lamp's spectrum is CIE FL11, a narrow-band fluorescent tube, instead of the published four values;
- the lamp, which the data put into the plane of the ceiling, hangs 0.1 mm below it;
- the walls are purely diffuse, as the simulations published with the box assume.
"""

import math
import pathlib

from gltf_writer import Scene, cross, lambert, lamp, subtract

FOLDER = pathlib.Path(__file__).parent / "cornell-box"
LUMINANCE = 30  # of the lamp [cd/m2]; exposes the picture well at 0 EV
LAMP_REFLECTANCE = 0.78
LAMP_GAP = 0.1  # [mm]
FOCAL_LENGTH, FILM = 0.035, 0.025
CAMERA = (278, 273, -800)

WALLS = {
    "floor": ("white", [(552.8, 0, 0), (0, 0, 0), (0, 0, 559.2), (549.6, 0, 559.2)]),
    "ceiling": ("white", [(556, 548.8, 0), (556, 548.8, 559.2), (0, 548.8, 559.2), (0, 548.8, 0)]),
    "back_wall": ("white", [(549.6, 0, 559.2), (0, 0, 559.2), (0, 548.8, 559.2), (556, 548.8, 559.2)]),
    "right_wall": ("green", [(0, 0, 559.2), (0, 0, 0), (0, 548.8, 0), (0, 548.8, 559.2)]),
    "left_wall": ("red", [(552.8, 0, 0), (549.6, 0, 559.2), (556, 548.8, 559.2), (556, 548.8, 0)]),
}
LIGHT = [(343, 548.8, 227), (343, 548.8, 332), (213, 548.8, 332), (213, 548.8, 227)]
BLOCK_TOPS = {
    "short_block": [(130, 165, 65), (82, 165, 225), (240, 165, 272), (290, 165, 114)],
    "tall_block": [(423, 330, 247), (265, 330, 296), (314, 330, 456), (472, 330, 406)],
}

# Reflectances at 400, 404, … 700 nm.
REFLECTANCES = {
    "white": [
    0.343, 0.445, 0.551, 0.624, 0.665, 0.687, 0.708, 0.723, 0.715, 0.71, 0.745, 0.758, 0.739,
    0.767, 0.777, 0.765, 0.751, 0.745, 0.748, 0.729, 0.745, 0.757, 0.753, 0.75, 0.746, 0.747,
    0.735, 0.732, 0.739, 0.734, 0.725, 0.721, 0.733, 0.725, 0.732, 0.743, 0.744, 0.748, 0.728,
    0.716, 0.733, 0.726, 0.713, 0.74, 0.754, 0.764, 0.752, 0.736, 0.734, 0.741, 0.74, 0.732,
    0.745, 0.755, 0.751, 0.744, 0.731, 0.733, 0.744, 0.731, 0.712, 0.708, 0.729, 0.73, 0.727,
    0.707, 0.703, 0.729, 0.75, 0.76, 0.751, 0.739, 0.724, 0.73, 0.74, 0.737,
    ],
    "green": [
    0.092, 0.096, 0.098, 0.097, 0.098, 0.095, 0.095, 0.097, 0.095, 0.094, 0.097, 0.098, 0.096,
    0.101, 0.103, 0.104, 0.107, 0.109, 0.112, 0.115, 0.125, 0.14, 0.16, 0.187, 0.229, 0.285,
    0.343, 0.39, 0.435, 0.464, 0.472, 0.476, 0.481, 0.462, 0.447, 0.441, 0.426, 0.406, 0.373,
    0.347, 0.337, 0.314, 0.285, 0.277, 0.266, 0.25, 0.23, 0.207, 0.186, 0.171, 0.16, 0.148,
    0.141, 0.136, 0.13, 0.126, 0.123, 0.121, 0.122, 0.119, 0.114, 0.115, 0.117, 0.117, 0.118,
    0.12, 0.122, 0.128, 0.132, 0.139, 0.144, 0.146, 0.15, 0.152, 0.157, 0.159,
    ],
    "red": [
    0.04, 0.046, 0.048, 0.053, 0.049, 0.05, 0.053, 0.055, 0.057, 0.056, 0.059, 0.057, 0.061,
    0.061, 0.06, 0.062, 0.062, 0.062, 0.061, 0.062, 0.06, 0.059, 0.057, 0.058, 0.058, 0.058,
    0.056, 0.055, 0.056, 0.059, 0.057, 0.055, 0.059, 0.059, 0.058, 0.059, 0.061, 0.061, 0.063,
    0.063, 0.067, 0.068, 0.072, 0.08, 0.09, 0.099, 0.124, 0.154, 0.192, 0.255, 0.287, 0.349,
    0.402, 0.443, 0.487, 0.513, 0.558, 0.584, 0.62, 0.606, 0.609, 0.651, 0.612, 0.61, 0.65,
    0.638, 0.627, 0.62, 0.63, 0.628, 0.642, 0.639, 0.657, 0.639, 0.635, 0.642,
    ],
}
# For renderers without spectra, linear sRGB of the reflectances under D65, rounded.
COLORS = {"white": (0.74, 0.74, 0.74), "green": (0.07, 0.4, 0.09), "red": (0.49, 0.05, 0.05)}


def block_faces(top):
    """The top and four sides down to the floor, all seen from outside."""
    sides = []
    for a, b in zip(top, top[1:] + top[:1]):
        sides.append([b, a, (a[0], 0, a[2]), (b[0], 0, b[2])])
    return [top] + sides


def metres(quad):
    return [tuple(x / 1000 for x in corner) for corner in quad]


def check_faces(name, quads, centre, inwards):
    """A quad turned the wrong way would be black or dark from behind."""
    for quad in quads:
        normal = cross(subtract(quad[1], quad[0]), subtract(quad[2], quad[0]))
        towards = sum(n * d for n, d in zip(normal, subtract(centre, quad[0])))
        assert (towards > 0) == inwards, f"{name} faces the wrong way"


def write_reflectance(name, values):
    lines = [f"# Cornell box, {name} paint, diffuse reflectance as measured by Cornell University's Program of Computer Graphics",
             "# https://www.graphics.cornell.edu/online/box/data.html",
             "wavelength_nm,reflectance"]
    lines += [f"{400 + 4 * i},{value}" for i, value in enumerate(values)]
    (FOLDER / f"{name}.csv").write_text("\n".join(lines) + "\n")


def main():
    FOLDER.mkdir(exist_ok=True)
    scene = Scene("Geometry and reflectances: Cornell University Program of Computer Graphics")
    materials = {}
    for name, values in REFLECTANCES.items():
        write_reflectance(name, values)
        materials[name] = scene.material(lambert(name, COLORS[name], extras={"reflectance_spectrum": f"{name}.csv"}))

    for name, (paint, quad) in WALLS.items():
        check_faces(name, [quad], (278, 273, 280), inwards=True)
        scene.quads(name, materials[paint], [metres(quad)])
    for name, top in BLOCK_TOPS.items():
        faces = block_faces(top)
        middle = [sum(corner[i] for corner in top) / 4 for i in range(3)]
        check_faces(name, faces, (middle[0], middle[1] / 2, middle[2]), inwards=False)
        scene.quads(name, materials["white"], [metres(face) for face in faces])

    light = [(x, y - LAMP_GAP, z) for x, y, z in LIGHT]
    check_faces("lamp", [light], (278, 273, 280), inwards=True)
    scene.quads("lamp", scene.material(lamp("lamp", LAMP_REFLECTANCE, LUMINANCE, "cie:FL11")), [metres(light)])

    # glTF cameras look along −z; half a turn about y makes it +z.
    scene.camera(2 * math.atan(FILM / 2 / FOCAL_LENGTH), [256, 256], translation=metres([CAMERA])[0], rotation=[0, 1, 0, 0])
    scene.write_gltf(FOLDER / "scene.gltf")


if __name__ == "__main__":
    main()
