"""`photopic info`: what it tells is what is in the file, computed here by hand."""

import json
import math
import pathlib
import unittest

from harness import CommandTest
from tiny_scene import tiny_scene, write_tiny_scene

FIXTURE = pathlib.Path(__file__).parent.parent / "gltf" / "all_features.gltf"


class Info(CommandTest):
    def info(self, scene, *options):
        text = self.photopic("info", scene, "--json", "info.json", *options).stdout
        return text, self.read_json("info.json")

    def test_tiny_scene(self):
        text, json_ = self.info(self.scene)
        self.assertEqual(json_["geometry"]["triangles"], 6)
        self.assertEqual(json_["geometry"]["vertices"], 12)
        for corner, expected in zip(json_["geometry"]["bounds_m"], [(-1, 0, -1), (1, 2, 1)]):
            for value, wanted in zip(corner, expected):
                self.assertAlmostEqual(value, wanted, places=5)
        self.assertEqual([m["name"] for m in json_["materials"]], ["floor", "wall", "lamp"])
        self.assertEqual([m["triangles"] for m in json_["materials"]], [2, 2, 2])
        for channel, wanted in zip(json_["materials"][1]["color_linear_srgb"], [0.6, 0.1, 0.05]):
            self.assertAlmostEqual(channel, wanted, delta=0.01)  # by way of a spectrum
        (lamp,) = json_["lamps"]
        self.assertEqual((lamp["name"], lamp["spectrum"]), ("lamp", "cie:D65"))
        self.assertAlmostEqual(lamp["luminance_cd_per_m2"], 5, places=5)
        self.assertAlmostEqual(lamp["area_m2"], 0.64, places=5)
        self.assertAlmostEqual(lamp["flux_lm"], 2 * math.pi * 5 * 0.64, places=3)  # both sides emit
        (camera,) = json_["cameras"]
        self.assertTrue(camera["used"])
        self.assertEqual(camera["resolution"], [32, 32])
        self.assertEqual(json_["warnings"], [])
        for word in ["floor", "cie:D65", "32x32", "triangles"]:
            self.assertIn(word, text)
        self.assertRegex(text, "650[345] K")

    def test_names_left_out_and_zeros_read_well(self):
        scene = tiny_scene()
        for material in scene["materials"]:
            material.pop("name")
        scene["materials"][0]["pbrMetallicRoughness"] = {"baseColorFactor": [1, 0, 0, 1]}
        self.scene.write_text(json.dumps(scene))
        text, _ = self.info(self.scene)
        self.assertIn("(no name)", text)
        self.assertIn("1.000 0.000 0.000", text)
        self.assertNotIn("-0.000", text)
        self.assert_refused(["info", self.scene, "--emitter", "lamp=cie:A"], "no emitter with a name")

    def test_options_as_render_has_them(self):
        text, json_ = self.info(self.scene, "--emitter", "lamp=blackbody:2700", "--resolution", "20x10")
        self.assertEqual(json_["lamps"][0]["spectrum"], "blackbody:2700")
        self.assertEqual(json_["cameras"][0]["resolution"], [20, 10])
        self.assertIn("2700 K", text)
        self.assert_refused(["info", self.scene, "--camera", "eye"], "eye")
        self.assert_refused(["info", self.scene, "--emitter", "torch=cie:A"], "torch")

    def test_the_camera_that_renders_whatever_it_is_called(self):
        scene = tiny_scene()
        plan = {"type": "orthographic", "orthographic": {"xmag": 2, "ymag": 2, "znear": 0.1, "zfar": 10}}
        scene["cameras"].append(plan)
        scene["nodes"] += [{"camera": 1, "translation": [0, 1, 3]}, {"camera": 1, "name": "B", "translation": [0, 1, 2]}]
        scene["scenes"] = [{"nodes": [0, 1, 2, 3]}]
        self.scene.write_text(json.dumps(scene))

        def cameras(*options):
            return [(c["name"], c["type"], c.get("position_m")) for c in self.info(self.scene, *options)[1]["cameras"]]

        unnamed, named = ("", "perspective"), ("B", "orthographic")
        self.assertEqual(cameras(), [(*unnamed, [0, 1, 4]), (*named, None)])
        self.assertEqual(cameras("--camera", "1"), [(*unnamed, None), ("", "orthographic", [0, 1, 3])])
        self.assertEqual(cameras("--camera", "B"), [(*unnamed, None), (*named, [0, 1, 2])])
        for camera in scene["cameras"]:
            camera["name"] = "twin"
        self.scene.write_text(json.dumps(scene))
        self.assertEqual([c[2] for c in cameras("--camera", "1")], [None, [0, 1, 3]])

    def test_lights_that_shine_whatever_they_are_called(self):
        scene = tiny_scene()
        lights = [{"type": "point", "name": "bulb", "intensity": 0}, {"type": "directional", "name": "bulb"}]
        scene["extensions"] = {"KHR_lights_punctual": {"lights": lights}}
        scene["extensionsUsed"].append("KHR_lights_punctual")
        scene["nodes"] += [{"extensions": {"KHR_lights_punctual": {"light": i}}} for i in range(2)]
        scene["scenes"] = [{"nodes": [0, 1, 2, 3]}]
        self.scene.write_text(json.dumps(scene))
        _, json_ = self.info(self.scene)
        self.assertEqual([(lamp["type"], lamp.get("used", True)) for lamp in json_["lamps"]],
                         [("surface", True), ("directional", True), ("point", False)])  # fmt: skip

    def test_what_a_render_leaves_out_is_told(self):
        text, json_ = self.info(FIXTURE)
        self.assertEqual(json_["file"]["animations"], 1)
        self.assertIn("animations are not played: 1", json_["warnings"])
        quiet = self.photopic("info", FIXTURE, "--quiet")
        self.assertEqual(quiet.stdout, "")
        self.assertEqual(quiet.stderr.splitlines(), [f"warning: {warning}" for warning in json_["warnings"]])
        self.assertIn("animations are not played: 1", text)
        self.assertEqual([(c["name"], c["type"], c["used"]) for c in json_["cameras"]],
                         [("eye", "perspective", True), ("plan", "orthographic", False)])  # fmt: skip
        self.assertLess(max(map(len, text.splitlines())), 700)

    def test_textures(self):
        text, json_ = self.info(FIXTURE)
        textures = {t["name"]: t for t in json_["textures"]}
        self.assertEqual(len(textures), 2)
        image = textures["in the buffer"]
        self.assertEqual((image["resolution"], image["channels"], image["bits"], image["bytes"]), ([2, 2], 4, 8, 16))
        self.assertEqual(image["encoding"], "sRGB and linear")
        self.assertIn("base color", image["read_for"])
        (coated,) = (m for m in json_["materials"] if m["name"] == "coated")
        expected = [
            "base color", "metallic-roughness", "normal", "emissive", "specular", "specular color", "clearcoat",
            "clearcoat roughness", "clearcoat normal", "sheen color", "sheen roughness", "anisotropy", "iridescence",
            "iridescence thickness",
        ]  # fmt: skip
        self.assertEqual(coated["textures"], expected)
        (glass,) = (m for m in json_["materials"] if m["name"] == "glass")
        self.assertEqual(glass["textures"], ["transmission", "diffuse transmission", "diffuse transmission color"])
        self.assertEqual(set(image["read_for"]), {*coated["textures"], *glass["textures"]} - {"metallic-roughness"})
        self.assertIn("2x2", text)

    def test_parameters(self):
        text, json_ = self.info(FIXTURE)
        coated, glass = ({m["name"]: m["parameters"] for m in json_["materials"]}[name] for name in ("coated", "glass"))
        wanted = {
            "clearcoat": 0.5, "clearcoat_roughness": 0.25, "sheen_roughness": 0.5, "anisotropy": 0.5,
            "anisotropy_rotation": 1, "iridescence": 1, "iridescence_ior": 1.25, "iridescence_thickness_nm": 400,
            "thinnest_film_nm": 100, "specular": 0.5,
        }  # fmt: skip
        self.assertEqual({name: coated[name] for name in wanted}, wanted)
        colors = [(coated, "sheen_color", [0.5, 0.25, 0.125]), (coated, "specular_color", [1, 0.5, 0.5]),
                  (glass, "attenuation_color", [0.5, 0.75, 1]), (glass, "diffuse_transmission_color", [1, 0.5, 0.5])]  # fmt: skip
        for parameters, name, color in colors:
            for channel, expected in zip(parameters[name], color, strict=True):
                self.assertAlmostEqual(channel, expected, delta=0.02, msg=name)
        self.assertIn("iridescence thickness nm 400", text)
        self.assertRegex(text, r"sheen color 0\.[45]\d\d 0\.2\d\d 0\.1\d\d")

    def test_lamps(self):
        _, json_ = self.info(FIXTURE)
        lamps = {lamp["name"]: lamp for lamp in json_["lamps"]}
        luminance = 0.2126 + 0.9 * 0.7152 + 0.8 * 0.0722  # of the sun's color
        self.assertAlmostEqual(lamps["sun"]["illuminance_lx"], 2 * luminance, places=3)
        self.assertAlmostEqual(lamps["bulb"]["intensity_cd"], 3, places=5)
        self.assertAlmostEqual(lamps["bulb"]["flux_lm"], 4 * math.pi * 3, places=4)
        self.assertEqual((lamps["torch"]["type"], lamps["torch"]["spectrum"]), ("spot", "cie:FL11"))
        self.assertEqual(lamps["lamp"]["spectrum"], "cie:A")
        # White where the texture is, 20 times linear sRGB 1, 0.5, 0.25 and no less than nothing.
        self.assertLess(lamps["coated"]["luminance_cd_per_m2"], 20 * (0.2126 + 0.5 * 0.7152 + 0.25 * 0.0722))
        self.assertGreater(lamps["coated"]["luminance_cd_per_m2"], 0)

    def test_a_dark_scene_gets_a_sky(self):
        write_tiny_scene(self.folder / "dark.gltf", emission=None)
        text, json_ = self.info("dark.gltf")
        self.assertEqual([lamp["type"] for lamp in json_["lamps"]], ["environment"])
        self.assertIn("overcast", text)

    def test_names_cannot_write_to_the_terminal(self):
        scene = tiny_scene()
        scene["materials"][0]["name"] = "\u001b[2J\nfloor"
        (self.folder / "odd.gltf").write_text(json.dumps(scene))
        text, json_ = self.info("odd.gltf")
        self.assertNotIn("\u001b", text)
        self.assertEqual(json_["materials"][0]["name"], "\u001b[2J\nfloor")

    def test_it_overwrites_nothing(self):
        before = self.scene.read_bytes()
        self.assert_refused(["info", self.scene, "--json", self.scene], "overwritten")
        self.assertEqual(self.scene.read_bytes(), before)


if __name__ == "__main__":
    unittest.main()
