"""Names and places: emitters, cameras and files by awkward names, extras that stand where nothing reads them."""

import json
import pathlib
import struct
import unittest

from exr import read_exr
from harness import CommandTest
from tiny_scene import tiny_scene


class NamesTest(CommandTest):
    def write_scene(self, scene, name="odd.gltf"):
        (self.folder / name).write_text(json.dumps(scene))
        return name

    def lit_scene(self, *names):
        """As many lamps as names: each of the three squares in turn, then lights."""
        scene = tiny_scene()
        for material, name in zip(scene["materials"], names):
            material.update(name=name, emissiveFactor=[1, 1, 1])
        return scene

    def lamps(self, scene, *options):
        self.photopic("info", scene, "--json", "info.json", *options)
        return {lamp["name"]: lamp["spectrum"] for lamp in self.read_json("info.json")["lamps"]}


class Emitters(NamesTest):
    def test_names_may_hold_equals_signs(self):
        scene = self.write_scene(self.lit_scene("a", "a=b", "c=d=e"))
        found = self.lamps(scene, "--emitter", "a=b=cie:A", "--emitter", "c=d=e=cie:FL11", "--emitter", "a=cie:D50")
        self.assertEqual(found, {"a": "cie:D50", "a=b": "cie:A", "c=d=e": "cie:FL11"})
        (self.folder / "x=y.csv").write_text("400 1\n700 1\n")
        self.assertEqual(self.lamps(scene, "--emitter", "a=b=x=y.csv")["a=b"], "x=y.csv")
        self.assert_refused(["info", scene, "--emitter", "a=b=x=y.csv", "--json", "x=y.csv"], "overwritten")

    def test_an_empty_name_is_refused(self):
        self.assert_refused(["info", self.scene, "--emitter", "=cie:A"], "--emitter =cie:A", "empty")

    def test_a_missing_name_among_many_shows_the_nearest(self):
        scene = tiny_scene()
        lights = [{"type": "point", "name": f"lamp number {i}"} for i in range(300)]
        scene["extensions"] = {"KHR_lights_punctual": {"lights": lights}}
        scene["extensionsUsed"].append("KHR_lights_punctual")
        for i in range(300):
            scene["nodes"].append({"extensions": {"KHR_lights_punctual": {"light": i}}})
            scene["scenes"][0]["nodes"].append(len(scene["nodes"]) - 1)
        name = self.write_scene(scene)
        self.assert_refused(["info", name, "--emitter", "lamp numbr 207=cie:A"], '"lamp number 207"', "301")
        refusal = self.run_photopic("info", name, "--emitter", "lamp numbr 207=cie:A").stderr
        self.assertLess(len(refusal), 300)


class Cameras(NamesTest):
    def setUp(self):
        super().setUp()
        scene = tiny_scene()
        scene["cameras"] = [dict(scene["cameras"][0], name=name) for name in ["Cam", "Cam", "1", "plan"]]
        for i in range(1, 4):
            scene["nodes"].append(dict(scene["nodes"][1], camera=i))
            scene["scenes"][0]["nodes"].append(len(scene["nodes"]) - 1)
        for i, camera in enumerate(scene["cameras"]):
            camera["extras"] = {"resolution": [10 + i, 10]}
        self.write_scene(scene)

    def width(self, camera):
        result = self.photopic("render", "odd.gltf", "-o", "a.exr", "--sampler", "uniform", "--spp", "1", "--quiet",
                               "--camera", camera, "--json", "a.json")  # fmt: skip
        return self.read_json("a.json")["resolution"][0], result.stderr

    def test_are_reached_by_name_and_by_index(self):
        for camera, width in [("0", 10), ("index:1", 11), ("1", 12), ("2", 12), ("plan", 13), ("index:3", 13)]:
            self.assertEqual(self.width(camera), (width, ""), camera)

    def test_namesakes_are_told(self):
        width, stderr = self.width("Cam")
        self.assertEqual(width, 10)
        self.assertEqual(len(stderr.splitlines()), 1)
        self.assertIn("index:1", stderr)

    def test_what_is_no_camera_is_refused(self):
        self.assert_refused(["info", "odd.gltf", "--camera", "Plan"], '"plan"')
        self.assert_refused(["info", "odd.gltf", "--camera", "index:4"], "index:4")
        self.assert_refused(["render", "odd.gltf", "-o", "a.exr", "--camera", ""], "--camera", "empty")

    def test_in_other_scenes_are_told(self):
        scene = json.loads((self.folder / "odd.gltf").read_text())
        scene["cameras"] += [dict(scene["cameras"][0], name="close"), dict(scene["cameras"][0], name="spare")]
        scene["nodes"] += [{"camera": 4}, {"children": [len(scene["nodes"])]}]
        scene["scenes"].append({"name": "Other", "nodes": [len(scene["nodes"]) - 1]})
        self.write_scene(scene)
        for camera in ["close", "4", "index:4"]:
            self.assert_refused(["info", "odd.gltf", "--camera", camera], f"--camera {camera}", 'scene 1 "Other"', "--scene index:1")
        self.assert_refused(["info", "odd.gltf", "--camera", "spare"], "in no scene")
        self.assert_refused(["info", "odd.gltf", "--camera", "6"], "no camera of that name or index")
        self.assertEqual(self.width("plan")[0], 13)
        self.photopic("info", "odd.gltf", "--scene", "index:1", "--camera", "close")

    def test_help_says_how(self):
        for command in ["render", "info", "compare"]:
            self.assertIn("index:N", self.photopic(command, "--help").stdout)


class Scenes(NamesTest):
    """Four scenes, each with a camera whose resolution tells them apart; the default is the second."""

    def setUp(self):
        super().setUp()
        scene = tiny_scene()
        scene["cameras"] = [dict(scene["cameras"][0], extras={"resolution": [10 + i, 10]}) for i in range(4)]
        scene["nodes"] += [{"camera": i} for i in range(4)]
        scene["scenes"] = [{"name": name, "nodes": [0, 2 + i]} for i, name in enumerate(["day", "night", "day", "1"])]
        scene["scene"] = 1
        self.document = scene
        self.write_scene(scene)

    def width(self, *options):
        result = self.photopic("render", "odd.gltf", "-o", "a.exr", "--sampler", "uniform", "--spp", "1", "--quiet",
                               "--json", "a.json", *options)  # fmt: skip
        return self.read_json("a.json")["resolution"][0], result.stderr

    def test_the_default_is_rendered_and_the_option_told(self):
        told = 'warning: of the file\'s 4 scenes scene 1 "night" is rendered; --scene chooses another\n'
        self.assertEqual(self.width(), (11, told))
        del self.document["scene"]
        self.write_scene(self.document)
        self.assertEqual(self.width()[0], 10)

    def test_are_reached_by_name_and_by_index(self):
        for scene, width in [("0", 10), ("night", 11), ("index:1", 11), ("2", 12), ("1", 13), ("index:3", 13)]:
            self.assertEqual(self.width("--scene", scene), (width, ""), scene)

    def test_namesakes_are_told(self):
        width, stderr = self.width("--scene", "day")
        self.assertEqual(width, 10)
        self.assertEqual(stderr, "warning: --scene day: several scenes have that name; the first is taken, others "
                                 "by their index, as index:2\n")  # fmt: skip

    def test_what_is_no_scene_is_refused(self):
        for scene in ["Night", "4", "index:4", "-1", "index:"]:
            self.assert_refused(["info", "odd.gltf", f"--scene={scene}"], f"--scene {scene}: odd.gltf has no", '"night"')
        del self.document["scenes"][1]["name"]
        self.write_scene(self.document)
        self.assert_refused(["info", "odd.gltf", "--scene", "night"], '"day", "index:1"')
        self.assert_refused(["render", "odd.gltf", "-o", "a.exr", "--scene", ""], "--scene", "empty")
        del self.document["scenes"], self.document["scene"]
        self.write_scene(self.document)
        self.assert_refused(["info", "odd.gltf", "--scene", "0"], "--scene 0", "leave the option out")

    def test_info_lists_them(self):
        text = self.photopic("info", "odd.gltf", "--scene", "2", "--json", "info.json").stdout
        listed = [(scene["name"], scene["used"]) for scene in self.read_json("info.json")["scenes"]]
        self.assertEqual(listed, [("day", False), ("night", False), ("day", True), ("1", False)])
        self.assertRegex(text, r"1 +night +not used")

    def test_compare_takes_one(self):
        self.photopic("compare", "odd.gltf", "--scene", "2", "--samplers", "uniform", "--spp", "1", "--reference-spp",
                      "2", "--json", "a.json", "--quiet")  # fmt: skip
        self.assertEqual(self.read_json("a.json")["scene"]["resolution"], [12, 10])


class Told(NamesTest):
    """Images and JSON say what was rendered as --scene and --camera would choose it."""

    def told(self, name, *options):
        render = ["--sampler", "uniform", "--spp", "1", "--resolution", "8x8", "--quiet"]
        self.photopic("render", name, "-o", "a.exr", "--json", "a.json", *render, *options)
        attributes, _ = read_exr(self.folder / "a.exr")
        told = [attributes.get(key, b"").decode() or None for key in ["scene_of_file", "camera"]]
        scene = self.read_json("a.json")["scene"]
        self.assertEqual([scene["scene"], scene["camera"]], told)
        return told

    def test_scenes_and_cameras(self):
        scene = tiny_scene()
        self.assertEqual(self.told(self.write_scene(scene)), ["index:0", "index:0"])
        scene["scenes"] = [dict(scene["scenes"][0], name=name) for name in ["S", "S", "T"]]
        scene["nodes"][1]["name"] = "eye"
        scene["nodes"].append(dict(scene["nodes"][1], name="other eye"))
        for nodes in scene["scenes"]:
            nodes["nodes"] = [0, 1, 2]
        name = self.write_scene(scene)
        self.assertEqual(self.told(name), ["S", "eye"])
        self.assertEqual(self.told(name, "--scene", "1"), ["index:1", "eye"])
        self.assertEqual(self.told(name, "--scene", "2", "--camera", "other eye"), ["T", "other eye"])
        scene["scenes"] = [{"nodes": [0]}]
        self.assertEqual(self.told(self.write_scene(scene)), ["index:0", None])
        self.photopic("compare", name, "--samplers", "uniform", "--spp", "1", "--reference-spp", "2", "--json", "c.json")
        self.assertEqual(self.read_json("c.json")["scene"]["camera"], None)


class StrayExtras(NamesTest):
    def warnings(self, change):
        scene = tiny_scene()
        change(scene)
        self.photopic("info", self.write_scene(scene), "--json", "info.json")
        return self.read_json("info.json")["warnings"]

    def assert_warned(self, change, *needles):
        (warning,) = self.warnings(change)
        for needle in needles:
            self.assertIn(needle, warning)

    def test_on_objects_instead_of_their_data(self):
        def on(list_, index, **extras):
            return lambda scene: scene[list_][index].update(extras=extras)

        self.assert_warned(on("nodes", 0, emission_spectrum="cie:A"), "#/nodes/0/extras/emission_spectrum", "material")
        self.assert_warned(on("meshes", 0, reflectance_spectrum="x.csv"), "#/meshes/0/extras/reflectance_", "material")
        self.assert_warned(on("nodes", 1, aperture_radius=0.1), "#/nodes/1/extras/aperture_radius", "camera")
        self.assert_warned(on("materials", 0, focus_distance=2), "#/materials/0/extras/focus_distance", "camera")
        self.assert_warned(
            lambda scene: scene["meshes"][0]["primitives"][2].update(extras={"conductor": "Au"}),
            "#/meshes/0/primitives/2/extras/conductor", "material",
        )  # fmt: skip

    def test_in_other_letters(self):
        for key, right in [("Conductor", "conductor"), ("emission_Spectrum", "emission_spectrum"),
                           ("reflectance spectrum", "reflectance_spectrum"), ("emissionSpectrum", "emission_spectrum"),
                           ("emission_spectrun", "emission_spectrum"), ("conductors", "conductor"),
                           ("emision_spectrum", "emission_spectrum"), ("gla-ss", "glass")]:  # fmt: skip
            self.assert_warned(lambda s: s["materials"][0].update(extras={key: "Au"}), f"/materials/0/extras/{key}",
                               f'did you mean "{right}"?')  # fmt: skip
        for key, right in [("apertureRadius", "aperture_radius"), ("focus-distance", "focus_distance")]:
            self.assert_warned(lambda s: s["cameras"][0]["extras"].update({key: 1}), f"/cameras/0/extras/{key}", right)
        self.assert_warned(lambda s: s["nodes"][1].update(extras={"focusDistance": 2}), "belongs to a camera")

    def test_once_for_many(self):
        def change(scene):
            scene["nodes"] += [{"extras": {"glass": "BK7"}} for _ in range(50)]

        self.assert_warned(change, "#/nodes/2/extras/glass", "49 more")

    def test_not_of_what_is_read_or_others(self):
        def change(scene):
            scene["materials"][2]["extras"] = {"emission_spectrum": "cie:A", "note": "bright"}
            scene["materials"][0]["extras"] = {"power_spectrum": "another tool's", "class": "floor", "": 1}
            scene["nodes"][0]["extras"] = {"prop": 1, "spectrum": "x", "glas": 1}

        self.assertEqual(self.warnings(change), [])


class Controls(NamesTest):
    def test_reach_no_terminal(self):
        evil = "e\u001b[31m\nvil\u009b2J"
        scene = tiny_scene()
        scene["materials"][2]["name"] = evil
        scene["cameras"][0]["name"] = evil
        scene["extensionsUsed"].append(evil)
        name = self.write_scene(scene)
        lamp = "l\u001bamp\u009b.csv"
        (self.folder / lamp).write_text("400 1\n700 1\n")
        render = ["render", name, "-o", "a\u001b\u009b.png", "--sampler", "uniform", "--spp", "1", "--stats"]
        for command in [
            ["info", name],
            ["info", name, "--emitter", "x=cie:A"],
            ["info", name, "--camera", "\u001b\u009b"],
            ["info", name, "--emitter", lamp],
            [*render, "--emitter", lamp],
            ["spectrum", lamp],
            ["optimize", lamp, "-o", "d.json", "--effort", "quick", "--wavelengths", "1"],
            ["diff", "a\u001b\u009b.png", "a\u001b\u009b.png"],
            ["\u001b\u009b"],
            ["render", "--\u001b\u009b"],
        ]:
            result = self.run_photopic(*command)
            text = result.stdout + result.stderr
            self.assertNotEqual(text, "", command)
            for control in "\u001b\u009b":
                self.assertNotIn(control, text, command)
        self.assertEqual(len(self.run_photopic("spectrum", lamp).stdout.splitlines()[0]), len(lamp) + 1)


class Contents(NamesTest):
    def test_decide_and_not_the_name(self):
        text = self.scene.read_bytes()
        (self.folder / "text.glb").write_bytes(b"\xef\xbb\xbf\n" + text)
        padded = text + b" " * (-len(text) % 4)
        header = b"glTF" + struct.pack("<II", 2, 20 + len(padded)) + struct.pack("<I4s", len(padded), b"JSON")
        (self.folder / "binary.gltf").write_bytes(header + padded)
        for name in ["text.glb", "binary.gltf"]:
            self.photopic("info", name, "--json", "info.json")
            self.assertEqual(self.read_json("info.json")["geometry"]["triangles"], 6)
        for name, content in [("none.glb", "no scene"), ("x.obj", "# Blender\nv 0 0 0\n"), ("x.usda", "#usda 1.0\n"),
                              ("x.blend", "BLENDER-v300"), ("x.fbx", "Kaydara FBX Binary"), ("list.gltf", "[]")]:  # fmt: skip
            (self.folder / name).write_text(content)
            self.assert_refused(["info", name], f"{name}: this is not a glTF file", "export the scene as .gltf or .glb")
        (self.folder / "cut.gltf").write_text('{"asset": ')
        self.assert_refused(["info", "cut.gltf"], "JSON")


class Scale(NamesTest):
    """A lamp's scale means nothing, be it ever so large or small."""

    def test_of_a_lamp_does_not_matter(self):
        results = []
        for exponent in ["0", "308", "-300", "-318"]:
            name = f"lamp{exponent}.txt"
            (self.folder / name).write_text(f"380 1e{exponent}\n500 1.5e{exponent}\n780 1e{exponent}\n")
            self.photopic("spectrum", name, "--json", "s.json", "--quiet")
            self.photopic("optimize", name, "-o", "d.json", "--effort", "quick", "--quiet", "--wavelengths", "1")
            self.photopic("render", self.scene, "-o", "a.exr", "--emitter", name, "--spp", "1", "--sampler",
                          "illuminant", "--quiet", "--json", "r.json")  # fmt: skip
            lamp = self.read_json("s.json")
            results.append([lamp["x"], lamp["y"], lamp["efficacy_lm_per_w"], self.read_json("d.json")["value"],
                            *self.read_json("r.json")["mean_xyz"]])  # fmt: skip
        for result in results[1:]:
            for value, expected in zip(result, results[0]):
                self.assertAlmostEqual(value / expected, 1, delta=2e-4)  # 1e-318 has four digits

    def test_lamps_of_unlike_scale_mix(self):
        (self.folder / "big.txt").write_text("380 1e308\n780 1e308\n")
        self.photopic("optimize", "big.txt", "cie:FL11*2", "-o", "d.json", "--effort", "quick", "--quiet")
        self.photopic("spectrum", "big.txt", "--plot", "a.svg")
        self.assertNotIn("nan", (self.folder / "a.svg").read_text())


class Messages(NamesTest):
    def test_say_what_is_wanted(self):
        render = ["render", self.scene, "-o", "a.exr", "--sampler", "uniform", "--spp", "1", "--quiet"]
        self.assert_refused(render + ["--seed", "-1"], "--seed", "0", "4294967295")
        self.assert_refused(render + ["--white-balance", "D65"], "--white-balance D65", "cie:D65", "illuminant")
        self.assert_refused(["spectrum", "FL11"], "cie:FL11")
        scene = tiny_scene()
        scene["materials"][0]["extras"] = {"glass": 1.5}
        self.assert_refused(["info", self.write_scene(scene)], "#/materials/0/extras/glass", "not the name of a glass", "BK7")


if __name__ == "__main__":
    unittest.main()
